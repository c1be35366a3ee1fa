#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "sigmascape/geo/local_frame.h"
#include "sigmascape/terrain/height_field.h"
#include "sigmascape/terrain/terrain_pyramid.h"
#include "sigmascape/terrain/terrain_reader.h"

namespace sigmascape::terrain {

/// Hands over the nodes of one tile of level 0, [row][column], all finite.
using FinestHeights = std::function<std::vector<float>(TileKey)>;

/// Makes every tile of a layout from the finest up, a level at a time, and hands each to `keep`; keeps few in memory:
/// `read` must give back tiles that were kept. Returns the summaries, one array a level.
///
/// A coarse node is the mean of the finer ones about it with weights 1 2 1 both ways; a tile's error is a bound, its
/// children's greatest plus its own distance from them.
[[nodiscard]] std::vector<Array2D<TileSummary>> build_tiles(const PyramidLayout& layout, const FinestHeights& finest,
                                                            const std::function<void(TileKey, const HeightTile&)>& keep,
                                                            const TerrainPyramid::Reader& read);

/// A pyramid in memory over a field, which is copied; beyond the field its edge goes on.
[[nodiscard]] TerrainPyramid pyramid_in_memory(const HeightField& field);

/// Builds a pyramid on disk from any raster that GDAL reads, a tile at a time: neither source nor pyramid need fit into
/// memory. Nodes without data get `no_data_height_m`. Nothing is done when the folder already holds the pyramid of this
/// source. Throws Error when the source cannot be read or the disk is full.
///
/// The folder: `level_<k>/<column>_<row>.tif` a tile, `level_<k>.tif` lowest, highest and error of its tiles, and last
/// `pyramid.toml`, without which the rest counts for nothing.
void build_pyramid(const std::filesystem::path& folder, const TerrainSource& source, const geo::LocalFrame& frame,
                   const radar::Rectangle& extent, double no_data_height_m = 0.0);

/// The same from a field in memory.
void build_pyramid(const std::filesystem::path& folder, const HeightField& field, const geo::LocalFrame& frame);

/// Whether a folder holds a finished pyramid.
[[nodiscard]] bool holds_pyramid(const std::filesystem::path& folder);

/// Opens a pyramid on disk. Throws Error when it is not there, not finished, or lacks its coarsest tile.
[[nodiscard]] TerrainPyramid open_pyramid(const std::filesystem::path& folder, std::size_t budget_bytes);

}  // namespace sigmascape::terrain
