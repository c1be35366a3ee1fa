#pragma once

#include <cstdint>
#include <string>

#include "sigmascape/base/array2d.h"
#include "sigmascape/geo/raster_placement.h"

namespace sigmascape::geo {

/// One band of bytes as a tiled, ZSTD-compressed GeoTIFF. Equal input gives equal bytes.
[[nodiscard]] std::string byte_geotiff_bytes(const RasterPlacement& placement, const std::string& band,
                                             const Array2D<std::uint8_t>& values);

}  // namespace sigmascape::geo
