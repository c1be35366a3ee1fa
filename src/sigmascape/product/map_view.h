#pragma once

#include <map>
#include <string>

#include "sigmascape/base/array2d.h"
#include "sigmascape/radar/channels.h"
#include "sigmascape/radar/ground_grid.h"
#include "sigmascape/radar/ground_map.h"
#include "sigmascape/radar/power_map.h"

namespace sigmascape::product {

/// The words and numbers in which files of a quantity differ from those of another.
struct MappedQuantity {
  const char* name;           ///< of the array in .npz
  const char* decibel_name;   ///< the same in decibels
  const char* words;          ///< as .json says it
  const char* decibel_words;  ///< the same in decibels
  const char* tag;            ///< as the GeoTIFF says it, by which it is known again
  const char* decibel_tag;    ///< the same in decibels
  const char* unit;           ///< of the bands; empty for a ratio
  const char* decibel_unit;   ///< the same in decibels
  double darkest_db;          ///< what is darker is written as this
  bool has_correlation;       ///< whether linear files hold Re VV·HH* as well
};

/// σ0, without unit.
[[nodiscard]] const MappedQuantity& sigma0_quantity();
/// Received power, in W and dBW.
[[nodiscard]] const MappedQuantity& power_quantity();

/// A map of either quantity, as those see it that write files. Must not outlive the map.
struct MapView {
  const radar::GroundGrid& grid;
  const Array2D<radar::Channels>& cells;  ///< [column, row], linear
  const std::string& crs;
  const std::map<std::string, std::string>& metadata;
  const MappedQuantity& quantity;
};

[[nodiscard]] inline MapView view_of(const radar::GroundMap& map) {
  return {map.grid, map.sigma0, map.crs, map.metadata, sigma0_quantity()};
}
[[nodiscard]] inline MapView view_of(const radar::PowerMap& map) {
  return {map.grid, map.power_w, map.crs, map.metadata, power_quantity()};
}

}  // namespace sigmascape::product
