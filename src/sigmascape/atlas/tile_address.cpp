#include "sigmascape/atlas/tile_address.h"

namespace sigmascape::atlas {
namespace {

/// The quotient rounded downwards, for numbers on both sides of the origin.
int floored(int value, int divisor) {
  return value >= 0 ? value / divisor : -((-value + divisor - 1) / divisor);
}

}  // namespace

radar::GroundGrid texels_of(const PatchGrid& patches, const TileAddress& tile) {
  const double tile_m = tile_side_m(patches, tile.level);
  return {tile.x * tile_m, (tile.y + 1) * tile_m, texel_side_m(patches, tile.level), tile_side, tile_side};
}

TilePlace place_of(const PatchGrid& patches, const TileAddress& tile) {
  const std::size_t coarsest_of_patch = patches.stored_levels() - 1;
  if (tile.level > coarsest_of_patch) {
    const std::size_t above = tile.level - coarsest_of_patch;
    const int side = 1 << above;
    return {{above, {tile.x * side, tile.y * side}}, 0, 0};
  }
  const int tiles_a_side = static_cast<int>((patches.texels_per_side >> tile.level) / tile_side);
  const PatchIndex patch{floored(tile.x, tiles_a_side), floored(tile.y, tiles_a_side)};
  const int column = tile.x - patch.x * tiles_a_side;
  const int row = tiles_a_side - 1 - (tile.y - patch.y * tiles_a_side);
  return {{0, patch}, tile.level, static_cast<std::size_t>(row * tiles_a_side + column)};
}

}  // namespace sigmascape::atlas
