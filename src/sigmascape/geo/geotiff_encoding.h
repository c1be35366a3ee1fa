#pragma once

#include <gdal_priv.h>
#include <initializer_list>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "sigmascape/geo/gdal_memory_file.h"
#include "sigmascape/geo/raster_placement.h"

namespace sigmascape::geo {

/// The side of the tiles that files are cut into, in cells.
inline constexpr int geotiff_tile_side = 256;

/// Throws Error with what GDAL says. Here and below, `what` is what is being written.
[[noreturn]] void fail_to_encode(std::string_view what);

/// An empty raster of floats in memory that lies in its place and carries its words.
[[nodiscard]] GDALDatasetUniquePtr floats_in_memory(std::string_view what, int columns, int rows, int bands,
                                                    const RasterPlacement& placement,
                                                    const std::map<std::string, std::string>& metadata);

/// Gives a raster overviews of so many times its cell; they are filled by the caller.
void add_empty_overviews(std::string_view what, GDALDataset& dataset, const std::vector<int>& factors);

/// Puts a raster where it lies on the globe.
void place(GDALDataset& dataset, const RasterPlacement& placement);

/// Encodes a raster, overviews included, with GDAL's options for creating a GeoTIFF. Into memory, because GDAL tells
/// late or never of a disk that is full.
void encode_geotiff(std::string_view what, GDALDataset& source, std::initializer_list<const char*> options,
                    const GdalMemoryFile& into);

}  // namespace sigmascape::geo
