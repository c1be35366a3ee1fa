#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sigmascape/base/array2d.h"
#include "sigmascape/geo/raster_placement.h"

namespace sigmascape::geo {

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
/// The bytes of that file, for whoever has something to put into them. `path` is where they will lie, for messages.
[[nodiscard]] std::string geotiff_bytes(const std::filesystem::path& path, const GeoRaster& raster);
/// Writes such bytes whole or not at all, and removes what others have noted of the file that lay there.
void write_geotiff_bytes(const std::filesystem::path& path, std::string_view bytes);
/// Whether a file of that name is known for a GeoTIFF: .tif or .tiff.
[[nodiscard]] bool is_geotiff_name(const std::filesystem::path& path);

/// Where the cells of a raster lie and how many there are.
struct RasterCells {
  RasterPlacement placement;
  std::size_t columns = 0, rows = 0;
};

/// Those of a north-up GeoTIFF with square cells, whose numbers are not read. Throws Error as read_geotiff.
[[nodiscard]] RasterCells read_cells(const std::filesystem::path& path);

/// Reads every band of a north-up GeoTIFF with square cells as float; a band's scale and offset are applied. Throws
/// Error when the file cannot be read whole, is not north up or has no CRS. `placement.crs` is the file's CRS as WKT2.
[[nodiscard]] GeoRaster read_geotiff(const std::filesystem::path& path);

}  // namespace sigmascape::geo
