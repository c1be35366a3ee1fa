#pragma once

#include <atomic>
#include <chrono>
#include <memory>
#include <utility>
#include <vector>

#include "sigmascape/base/array2d.h"
#include "sigmascape/base/error.h"
#include "sigmascape/terrain/height_field.h"
#include "sigmascape/terrain/pyramid_levels.h"

namespace sigmascape::live {

/// Terrain of which none but the last level's tile can be had while it is short of them, and which is patient for a
/// millisecond.
inline std::shared_ptr<terrain::TerrainPyramid> short_of(const terrain::HeightField& field,
                                                         const std::atomic<bool>& is_short) {
  const auto whole =
      std::shared_ptr<terrain::TerrainPyramid>(new terrain::TerrainPyramid(terrain::pyramid_in_memory(field)));
  std::vector<Array2D<terrain::TileSummary>> summaries;
  for (int level = 0; level < whole->levels(); ++level) {
    auto& of_level = summaries.emplace_back(whole->layout().across(level), whole->layout().down(level));
    for (std::uint32_t row = 0; row < of_level.rows(); ++row)
      for (std::uint32_t column = 0; column < of_level.columns(); ++column)
        of_level(column, row) = whole->summary({level, column, row});
  }
  return std::make_shared<terrain::TerrainPyramid>(
      whole->layout(), whole->extent(), std::move(summaries),
      [whole, &is_short](terrain::TileKey key) {
        if (is_short && key.level + 1 < whole->levels()) throw Error("tile", "cannot be opened", "close other files");
        return whole->load(key);
      },
      std::size_t{64} << 20U, std::chrono::milliseconds(1));
}

}  // namespace sigmascape::live
