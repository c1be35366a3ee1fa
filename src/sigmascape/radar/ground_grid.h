#pragma once

#include <cstddef>

#include "sigmascape/base/vec.h"

namespace sigmascape::radar {

/// A rectangle of the local frame, in metres.
struct Rectangle {
  double west_m = 0.0, south_m = 0.0, east_m = 0.0, north_m = 0.0;

  friend constexpr bool operator==(const Rectangle&, const Rectangle&) = default;
  [[nodiscard]] constexpr double width_m() const { return east_m - west_m; }
  [[nodiscard]] constexpr double height_m() const { return north_m - south_m; }
  [[nodiscard]] constexpr Vec2d centre() const { return {(west_m + east_m) / 2.0, (south_m + north_m) / 2.0}; }
  [[nodiscard]] constexpr bool contains(Vec2d p) const {
    return p.x >= west_m && p.x <= east_m && p.y >= south_m && p.y <= north_m;
  }
};

/// Square cells on the ground, north up: row 0 is the northernmost, column 0 the westernmost, as in a picture or a
/// GeoTIFF.
struct GroundGrid {
  double west_m = 0.0;   ///< western edge of column 0
  double north_m = 0.0;  ///< northern edge of row 0
  double cell_m = 1.0;
  std::size_t columns = 0;
  std::size_t rows = 0;

  friend constexpr bool operator==(const GroundGrid&, const GroundGrid&) = default;
  [[nodiscard]] constexpr Rectangle extent() const {
    return {west_m, north_m - static_cast<double>(rows) * cell_m, west_m + static_cast<double>(columns) * cell_m,
            north_m};
  }
  [[nodiscard]] constexpr Vec2d centre_of(std::size_t column, std::size_t row) const {
    return {west_m + (static_cast<double>(column) + 0.5) * cell_m, north_m - (static_cast<double>(row) + 0.5) * cell_m};
  }
  /// Where a point lies in units of cells: (0, 0) is the north-western corner of cell (0, 0), (0.5, 0.5) its centre.
  [[nodiscard]] constexpr Vec2d cells_from(Vec2d p) const {
    return {(p.x - west_m) / cell_m, (north_m - p.y) / cell_m};
  }
  [[nodiscard]] constexpr double cell_area_m2() const { return cell_m * cell_m; }
};

}  // namespace sigmascape::radar
