#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>

#include "sigmascape/product/map_file.h"
#include "sigmascape/product/map_view.h"

namespace sigmascape::product {

/// Writes a map of either quantity as a cloud-optimised GeoTIFF: see write_map.
void write_map_geotiff(const std::filesystem::path& path, const MapView& map, MapScale scale);

/// What such a file holds, linear; channels that it does not have are NaN.
struct MapContent {
  radar::GroundGrid grid;
  Array2D<radar::Channels> cells;
  std::string crs;
  std::map<std::string, std::string> metadata;
};

/// Reads a file of the given quantity. Throws Error when it is a map of another one, cannot be read or lacks a band:
/// one of all that such a map has, or where a polarization is given of those that its power is of.
[[nodiscard]] MapContent read_map_geotiff(const std::filesystem::path& path, const MappedQuantity& quantity,
                                          std::optional<radar::Polarization> polarization = {});

}  // namespace sigmascape::product
