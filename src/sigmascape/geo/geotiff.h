#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "sigmascape/base/array2d.h"
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

struct NamedBand {
  std::string name;
  Array2D<float> values;     ///< [column, row]; all bands of a raster have the same size
  bool is_classes = false;   ///< numbers that stand for names, of which there is no mean
  bool is_decibels = false;  ///< means are those of the powers that they stand for
  std::string unit = {};     ///< as a GIS shows it: "W", "dB"; empty for none
};

/// Several named layers of numbers over the same cells.
struct GeoRaster {
  RasterPlacement placement;
  std::vector<NamedBand> bands;
  std::optional<float> nodata;  ///< the value that means "nothing known here"; NaN is allowed
  std::map<std::string, std::string> metadata;
};

/// Writes a cloud-optimised float32 GeoTIFF (tiles of 256², ZSTD), atomically. Overviews go down to one tile; their
/// cells are the means of what is known of those that they cover, of classes the north-western one. Equal rasters give
/// equal bytes.
/// Throws Error when the raster has no bands or bands of different size, the CRS is not understood, or the disk is
/// full.
void write_geotiff(const std::filesystem::path& path, const GeoRaster& raster);

/// Reads every band of a north-up GeoTIFF with square cells as float; a band's scale and offset are applied. Throws
/// Error when the file cannot be read whole, is not north up or has no CRS. `placement.crs` is the file's CRS as WKT2.
[[nodiscard]] GeoRaster read_geotiff(const std::filesystem::path& path);

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

/// One band of bytes as a tiled, ZSTD-compressed GeoTIFF. Equal input gives equal bytes.
[[nodiscard]] std::string byte_geotiff_bytes(const RasterPlacement& placement, const std::string& band,
                                             const Array2D<std::uint8_t>& values);

/// Corners of a raster as longitude (x) and latitude (y) in degrees on WGS 84: south-west, south-east, north-east,
/// north-west. Throws Error when the CRS is not understood or does not reach there.
[[nodiscard]] std::array<Vec2d, 4> geographic_corners(const RasterPlacement& placement, std::size_t columns,
                                                      std::size_t rows);

/// Whether a CRS counts in degrees and not in metres. Throws Error when PROJ does not understand it.
[[nodiscard]] bool is_in_degrees(const std::string& crs);

/// The CRS as WKT2 (ISO 19162:2019), on one line. Throws Error when PROJ does not understand it.
[[nodiscard]] std::string wkt2_from(const std::string& crs);

}  // namespace sigmascape::geo
