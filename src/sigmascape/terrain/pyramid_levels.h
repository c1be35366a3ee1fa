#pragma once

#include <functional>
#include <vector>

#include "sigmascape/base/array2d.h"
#include "sigmascape/terrain/height_field.h"
#include "sigmascape/terrain/height_tile.h"
#include "sigmascape/terrain/terrain_pyramid.h"

namespace sigmascape::terrain {

/// Hands over the nodes of one tile of level 0, [row][column], all finite.
using FinestHeights = std::function<std::vector<float>(TileKey)>;

/// Makes every tile of a layout from the finest up, a level at a time, and hands each to `keep`; keeps few in memory:
/// `read` must give back tiles that were kept. Tiles that `there` gives, if it is given, are not made again; of others
/// it gives null. Returns the summaries, one array a level.
///
/// A coarse node is the mean of the finer ones about it with weights 1 2 1 both ways; a tile's error is a bound, its
/// children's greatest plus its own distance from them.
[[nodiscard]] std::vector<Array2D<TileSummary>> build_tiles(const PyramidLayout& layout, const FinestHeights& finest,
                                                            const std::function<void(TileKey, const HeightTile&)>& keep,
                                                            const TerrainPyramid::Reader& read,
                                                            const TerrainPyramid::Reader& there = {});

/// A pyramid in memory over a field, which is copied; beyond the field its edge goes on.
[[nodiscard]] TerrainPyramid pyramid_in_memory(const HeightField& field);

/// Nodes of a tile of level 0 from a field, whose edge goes on beyond it.
[[nodiscard]] std::vector<float> nodes_of_field(const HeightField& field, TileKey key);

}  // namespace sigmascape::terrain
