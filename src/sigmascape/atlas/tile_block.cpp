#include "sigmascape/atlas/tile_block.h"

#include <cmath>

namespace sigmascape::atlas {

std::optional<std::size_t> TileBlock::number_of(const TileAddress& tile) const {
  if (tile.level != level) return std::nullopt;
  // Before the first they are more than any number of tiles.
  const auto column = static_cast<std::size_t>(tile.x - west), row = static_cast<std::size_t>(north - tile.y);
  if (column >= across || row >= down) return std::nullopt;
  return row * across + column;
}

TileBlock tiles_over(const PatchGrid& patches, const radar::Rectangle& area, std::size_t level) {
  if (area.width_m() <= 0.0 || area.height_m() <= 0.0) return {.level = level};
  const double tile_m = tile_side_m(patches, level);
  const auto first = [tile_m](double edge) { return static_cast<int>(std::floor(edge / tile_m)); };
  const auto last = [tile_m](double edge) { return static_cast<int>(std::ceil(edge / tile_m)) - 1; };
  const int west = first(area.west_m), north = last(area.north_m);
  return {level, west, north, static_cast<std::size_t>(last(area.east_m) - west + 1),
          static_cast<std::size_t>(north - first(area.south_m) + 1)};
}

}  // namespace sigmascape::atlas
