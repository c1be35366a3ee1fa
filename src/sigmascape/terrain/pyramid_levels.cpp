#include "sigmascape/terrain/pyramid_levels.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <utility>

namespace sigmascape::terrain {
namespace {

constexpr auto cells_a_side = static_cast<std::int64_t>(HeightTile::cells);

/// Nodes of one finished level, wherever they stand; remembers a few tiles.
class LevelNodes {
 public:
  LevelNodes(const PyramidLayout& layout, int level, const TerrainPyramid::Reader& read)
      : layout_(layout), level_(level), read_(read) {}

  /// Nodes of the level from (column, row) on; beyond the last tile its edge goes on.
  Array2D<float> block(std::int64_t column, std::int64_t row, std::size_t side) {
    Array2D<float> result(side, side);
    const std::int64_t last_column = cells_a_side * layout_.across(level_),
                       last_row = cells_a_side * layout_.down(level_);
    for (std::size_t j = 0; j < side; ++j) {
      const std::int64_t at_row = std::clamp<std::int64_t>(row + static_cast<std::int64_t>(j), 0, last_row);
      for (std::size_t i = 0; i < side; ++i) {
        const std::int64_t at_column = std::clamp<std::int64_t>(column + static_cast<std::int64_t>(i), 0, last_column);
        const auto tile_column = std::min<std::int64_t>(at_column / cells_a_side, layout_.across(level_) - 1);
        const auto tile_row = std::min<std::int64_t>(at_row / cells_a_side, layout_.down(level_) - 1);
        const HeightTile& held =
            tile({level_, static_cast<std::uint32_t>(tile_column), static_cast<std::uint32_t>(tile_row)});
        const auto within = static_cast<std::size_t>(at_row - cells_a_side * tile_row) * HeightTile::nodes +
                            static_cast<std::size_t>(at_column - cells_a_side * tile_column);
        result(i, j) = held.height_m[within];
      }
    }
    return result;
  }

 private:
  const HeightTile& tile(TileKey key) {
    if (latest_ != nullptr && key == latest_key_) return *latest_;
    constexpr std::size_t most = 24;
    auto found = tiles_.find(key);
    if (found == tiles_.end()) {
      if (tiles_.size() >= most) tiles_.clear();
      found = tiles_.emplace(key, read_(key)).first;
    }
    latest_key_ = key;
    latest_ = found->second.get();
    return *latest_;
  }

  const PyramidLayout& layout_;
  int level_;
  const TerrainPyramid::Reader& read_;
  std::map<TileKey, std::shared_ptr<const HeightTile>> tiles_;
  TileKey latest_key_;
  const HeightTile* latest_ = nullptr;
};

void note_bounds(HeightTile& tile) {
  const auto [lowest, highest] = std::ranges::minmax_element(tile.height_m);
  tile.summary.lowest_m = *lowest;
  tile.summary.highest_m = *highest;
}

/// A tile from a block of the finer level that begins one node before it.
HeightTile coarser(const Array2D<float>& finer) {
  HeightTile tile{.height_m = std::vector<float>(HeightTile::nodes * HeightTile::nodes)};
  for (std::size_t row = 0; row < HeightTile::nodes; ++row) {
    for (std::size_t column = 0; column < HeightTile::nodes; ++column) {
      float sum = 0.0F;
      for (std::size_t j = 0; j < 3; ++j) {
        for (std::size_t i = 0; i < 3; ++i) {
          const float weight = (i == 1 ? 2.0F : 1.0F) * (j == 1 ? 2.0F : 1.0F);
          sum += weight * finer(2 * column + i, 2 * row + j);
        }
      }
      tile.height_m[row * HeightTile::nodes + column] = sum / 16.0F;
    }
  }
  note_bounds(tile);
  return tile;
}

/// The furthest that a node of the finer level lies from the tile's surface. No point between nodes lies further: the
/// difference of two bilinear surfaces is bilinear within each finer cell.
float distance_between(const HeightTile& tile, const Array2D<float>& finer) {
  float furthest = 0.0F;
  for (std::size_t row = 0; row <= 2 * HeightTile::cells; ++row) {
    for (std::size_t column = 0; column <= 2 * HeightTile::cells; ++column) {
      const float surface = tile.at(0.5 * static_cast<double>(column), 0.5 * static_cast<double>(row));
      furthest = std::max(furthest, std::abs(surface - finer(column + 1, row + 1)));
    }
  }
  return furthest;
}

/// Bounds and greatest error of a tile's children, and its own bounds.
TileSummary joined_with_children(TileKey key, TileSummary joined, const Array2D<TileSummary>& finer) {
  const std::size_t first_column = std::size_t{2} * key.column, first_row = std::size_t{2} * key.row;
  for (std::size_t row = first_row; row < std::min(first_row + 2, finer.rows()); ++row) {
    for (std::size_t column = first_column; column < std::min(first_column + 2, finer.columns()); ++column) {
      const TileSummary& child = finer(column, row);
      joined = {std::min(joined.lowest_m, child.lowest_m), std::max(joined.highest_m, child.highest_m),
                std::max(joined.error_m, child.error_m)};
    }
  }
  return joined;
}

}  // namespace

std::vector<float> nodes_of_field(const HeightField& field, TileKey key) {
  std::vector<float> nodes(HeightTile::nodes * HeightTile::nodes);
  for (std::size_t j = 0; j < HeightTile::nodes; ++j) {
    const std::size_t row = std::min(HeightTile::cells * key.row + j, field.height_m.rows() - 1);
    for (std::size_t i = 0; i < HeightTile::nodes; ++i) {
      const std::size_t column = std::min(HeightTile::cells * key.column + i, field.height_m.columns() - 1);
      nodes[j * HeightTile::nodes + i] = field.height_m(column, row);
    }
  }
  return nodes;
}

std::vector<Array2D<TileSummary>> build_tiles(const PyramidLayout& layout, const FinestHeights& finest,
                                              const std::function<void(TileKey, const HeightTile&)>& keep,
                                              const TerrainPyramid::Reader& read, const TerrainPyramid::Reader& there) {
  std::vector<Array2D<TileSummary>> summaries;
  for (int level = 0; level < layout.levels(); ++level) {
    Array2D<TileSummary> of_level(layout.across(level), layout.down(level));
    LevelNodes nodes(layout, level - 1, read);
    for (std::uint32_t row = 0; row < layout.down(level); ++row) {
      for (std::uint32_t column = 0; column < layout.across(level); ++column) {
        const TileKey key{level, column, row};
        if (const auto made = there ? there(key) : nullptr) {
          of_level(column, row) = made->summary;
          continue;
        }
        HeightTile tile;
        if (level == 0) {
          tile.height_m = finest(key);
          note_bounds(tile);
        } else {
          const auto finer =
              nodes.block(2 * cells_a_side * column - 1, 2 * cells_a_side * row - 1, 2 * HeightTile::cells + 3);
          tile = coarser(finer);
          tile.summary = joined_with_children(key, tile.summary, summaries.back());
          tile.summary.error_m += distance_between(tile, finer);
        }
        keep(key, tile);
        of_level(column, row) = tile.summary;
      }
    }
    summaries.push_back(std::move(of_level));
  }
  return summaries;
}

TerrainPyramid pyramid_in_memory(const HeightField& field) {
  const auto layout = PyramidLayout::covering(field.extent(), field.spacing_m);
  const auto tiles = std::make_shared<std::map<TileKey, std::shared_ptr<const HeightTile>>>();
  const TerrainPyramid::Reader read = [tiles](TileKey key) { return tiles->at(key); };
  auto summaries = build_tiles(
      layout, [&](TileKey key) { return nodes_of_field(field, key); },
      [&](TileKey key, const HeightTile& tile) { tiles->emplace(key, std::make_shared<const HeightTile>(tile)); },
      read);
  return {layout, field.extent(), std::move(summaries), read, tiles->size() * HeightTile::bytes};
}

}  // namespace sigmascape::terrain
