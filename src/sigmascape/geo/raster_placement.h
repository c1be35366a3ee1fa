#pragma once

#include <array>
#include <cstddef>
#include <string>

#include "sigmascape/base/vec.h"

namespace sigmascape::geo {

/// Where a north-up raster of square cells lies: row 0 is the northernmost, column 0 the westernmost.
struct RasterPlacement {
  double west_m = 0.0;   ///< western edge of column 0
  double north_m = 0.0;  ///< northern edge of row 0
  double cell_m = 1.0;
  std::string crs;  ///< anything PROJ understands; usually LocalFrame::proj()

  friend bool operator==(const RasterPlacement&, const RasterPlacement&) = default;
};

/// Corners of a raster as longitude (x) and latitude (y) in degrees on WGS 84: south-west, south-east, north-east,
/// north-west. Throws Error when the CRS is not understood or does not reach there.
[[nodiscard]] std::array<Vec2d, 4> geographic_corners(const RasterPlacement& placement, std::size_t columns,
                                                      std::size_t rows);

}  // namespace sigmascape::geo
