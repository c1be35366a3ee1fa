#pragma once

#include <cstddef>
#include <filesystem>

#include "sigmascape/geo/local_frame.h"
#include "sigmascape/terrain/height_field.h"
#include "sigmascape/terrain/terrain_pyramid.h"
#include "sigmascape/terrain/terrain_reader.h"

namespace sigmascape::terrain {

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

/// Whether a folder holds a finished pyramid that was made from this field.
[[nodiscard]] bool holds_pyramid_of(const std::filesystem::path& folder, const HeightField& field,
                                    const geo::LocalFrame& frame);

}  // namespace sigmascape::terrain
