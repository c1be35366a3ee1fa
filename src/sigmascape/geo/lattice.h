#pragma once

#include <cstddef>

namespace sigmascape::geo {

/// A rectangle of a local frame, in metres.
struct Extent {
  double west_m = 0.0, south_m = 0.0, east_m = 0.0, north_m = 0.0;

  friend constexpr bool operator==(const Extent&, const Extent&) = default;
  [[nodiscard]] constexpr bool empty() const { return !(east_m > west_m && north_m > south_m); }
};

/// Points of a local frame where a raster is wanted: (column, row) stands at (west + column · spacing, north − row ·
/// spacing).
struct Lattice {
  double west_m = 0.0, north_m = 0.0;  ///< the north-western point itself
  double spacing_m = 1.0;
  std::size_t columns = 0, rows = 0;
};

}  // namespace sigmascape::geo
