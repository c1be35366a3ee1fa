#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "sigmascape/atlas/tile_block.h"
#include "sigmascape/base/vec.h"
#include "sigmascape/live/obstacle_page.h"
#include "sigmascape/live/part_of_tile.h"
#include "sigmascape/radar/ground_grid.h"

namespace sigmascape::live {

/// What stands on the ground under a frame: tiles of one level side by side, each shown by its own page or by that of a
/// coarser one. It refers to the pages, which live as long as the view that they were found in.
class ObstacleMosaic {
 public:
  /// Nothing stands in any tile. Keeps its memory as long as the block needs no more of it.
  void reset(const atlas::PatchGrid& patches, const atlas::TileBlock& block);
  /// For a tile of the block: its page, or that of an ancestor.
  void put(std::size_t column, std::size_t row, const ObstaclePage& page);

  [[nodiscard]] const atlas::TileBlock& block() const { return block_; }
  /// All squares, those of tiles without a page included.
  [[nodiscard]] const radar::GroundGrid& grid() const { return grid_; }

  /// Squares are numbered tile by tile, within each row by row. What stands on one of them.
  [[nodiscard]] PackedObstacle at(std::int32_t square) const {
    const auto number = static_cast<std::uint32_t>(square);
    const Piece& piece = pieces_[number / ObstaclePage::squares];
    const std::uint32_t within = number % ObstaclePage::squares;
    if (piece.levels_up == 0) return piece.of[within];
    constexpr auto side = static_cast<std::uint32_t>(atlas::tile_side);
    return piece.of[(within / side >> piece.levels_up) * side + (within % side >> piece.levels_up)];
  }
  /// At a point; nothing outside.
  [[nodiscard]] PackedObstacle at(Vec2d point) const;

 private:
  /// From the first square of a page that shows the tile.
  struct Piece {
    const PackedObstacle* of = &nothing;
    std::uint32_t levels_up = 8;
  };
  static constexpr PackedObstacle nothing{};

  atlas::TileBlock block_;
  radar::GroundGrid grid_{.columns = 0, .rows = 0};
  std::vector<Piece> pieces_;  // [row][column] of the block
};

}  // namespace sigmascape::live
