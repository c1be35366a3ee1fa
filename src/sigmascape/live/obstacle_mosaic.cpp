#include "sigmascape/live/obstacle_mosaic.h"

namespace sigmascape::live {

void ObstacleMosaic::reset(const atlas::PatchGrid& patches, const atlas::TileBlock& block) {
  block_ = block;
  grid_ = atlas::texels_of(patches, block.at(0, 0));
  grid_.columns *= block.across;
  grid_.rows *= block.down;
  pieces_.assign(block.size(), Piece{});
}

void ObstacleMosaic::put(std::size_t column, std::size_t row, const ObstaclePage& page) {
  const PartOfTile part = PartOfTile::of(block_.at(column, row), page.key);
  pieces_[row * block_.across + column] = {page.of.data() + part.index_of(0, 0), part.levels_up};
}

PackedObstacle ObstacleMosaic::at(Vec2d point) const {
  const Vec2d cell = grid_.cells_from(point);
  if (!(cell.x >= 0.0 && cell.y >= 0.0 && cell.x < static_cast<double>(grid_.columns) &&
        cell.y < static_cast<double>(grid_.rows))) {
    return {};
  }
  constexpr std::size_t side = atlas::tile_side;
  const auto column = static_cast<std::size_t>(cell.x), row = static_cast<std::size_t>(cell.y);
  const std::size_t tile = row / side * block_.across + column / side;
  return at(static_cast<std::int32_t>((tile * side + row % side) * side + column % side));
}

}  // namespace sigmascape::live
