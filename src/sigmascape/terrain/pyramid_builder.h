#pragma once

#include <filesystem>
#include <functional>
#include <optional>
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

struct PyramidBuild {
  std::size_t tiles_written = 0;
  /// Nodes of level 0, of the tiles written and within the extent, of which the source tells no height.
  std::size_t nodes_without_height = 0;
};

/// Builds a pyramid on disk from any raster that GDAL reads, a tile at a time: neither source nor pyramid need fit into
/// memory. Nodes without a height get `no_data_height_m`. Tiles that are there and whole are left, if they were made
/// from the same heights: what was interrupted goes on, what was damaged is mended. What a folder held of other heights
/// stays until the new ones are whole. Throws Error when the source cannot be read or the disk is full.
///
/// The folder: see pyramid_files.h; without its heading the rest counts for nothing.
PyramidBuild build_pyramid(const std::filesystem::path& folder, const TerrainSource& source,
                           const geo::LocalFrame& frame, const radar::Rectangle& extent, double no_data_height_m = 0.0);

/// The same from a field in memory. Returns how many tiles were written.
std::size_t build_pyramid(const std::filesystem::path& folder, const HeightField& field, const geo::LocalFrame& frame);

/// Whether a folder holds the heading of a finished pyramid, whatever that is like.
[[nodiscard]] bool holds_pyramid(const std::filesystem::path& folder);
/// Whether it says that it was made from a field in memory, as bakes make it, rather than from a raster. Those of a
/// former kind do not say.
[[nodiscard]] bool holds_pyramid_of_a_field(const std::filesystem::path& folder);
/// Whether it was made from this field.
[[nodiscard]] bool holds_pyramid_of(const std::filesystem::path& folder, const HeightField& field,
                                    const geo::LocalFrame& frame);

struct PyramidFault {
  std::filesystem::path file;  ///< relative to the folder
  std::string what;            ///< "is missing", "is truncated or was altered", "cannot be read (…)"
};

/// What is wrong with the heading of a finished pyramid, if anything: without one that can be understood the rest
/// counts for nothing.
[[nodiscard]] std::optional<PyramidFault> heading_fault(const std::filesystem::path& folder);

/// Reads every file of a pyramid on disk and returns those that are not as they were written: tiles that say that they
/// lie elsewhere in `frame`, in which the pyramid was built, among them.
[[nodiscard]] std::vector<PyramidFault> verify_pyramid(const std::filesystem::path& folder,
                                                       const geo::LocalFrame& frame);

/// Those that are not there at all, its heading among them; reads nothing else.
[[nodiscard]] std::vector<PyramidFault> missing_files(const std::filesystem::path& folder);

/// Opens a pyramid on disk. Throws Error when it is not there, not finished, or lacks its coarsest tile.
[[nodiscard]] TerrainPyramid open_pyramid(const std::filesystem::path& folder, std::size_t budget_bytes);

}  // namespace sigmascape::terrain
