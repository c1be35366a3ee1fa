#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "sigmascape/geo/raster_placement.h"

namespace sigmascape::geo {

/// The same raster at several resolutions, for 16-bit floats: level 0 is the finest, each next has half the columns and
/// rows.
struct HalfPyramid {
  RasterPlacement placement;  ///< of level 0
  std::vector<std::string> band_names;
  /// What a stored number is multiplied by to give the quantity; a GIS does so by itself.
  double scale = 1.0;
  /// Per level the stored numbers, pixel-interleaved: (row · columns + column) · bands + band. Each must be a finite
  /// number that a 16-bit float holds exactly: GDAL's own narrowing truncates, so rounding is the caller's.
  std::vector<std::vector<float>> levels;
  std::size_t columns = 0;  ///< of level 0, 256 · 2ⁿ with n + 1 levels: overviews end at one tile
  std::size_t rows = 0;     ///< of level 0, equal to `columns`
  std::map<std::string, std::string> metadata;
};

/// A cloud-optimised GeoTIFF as bytes: half floats (NBITS = 16), tiles of 256², pixel-interleaved, ZSTD, with the given
/// levels as its overviews. Equal pyramids give equal bytes. Throws Error when the shape is not as HalfPyramid says.
[[nodiscard]] std::string half_cog_bytes(const HalfPyramid& pyramid);

}  // namespace sigmascape::geo
