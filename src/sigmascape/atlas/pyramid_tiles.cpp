#include "sigmascape/atlas/pyramid_tiles.h"

#include <fmt/format.h>

#include "sigmascape/atlas/texture_name.h"

namespace sigmascape::atlas {
namespace {

/// 2³⁰ patches a side are more than any lattice number.
constexpr std::size_t highest_level = 30;

/// The largest multiple of 2ˡᵉᵛᵉˡ that is not above. Shifts of negative numbers round down in C++20.
int aligned(int number, std::size_t level) {
  return (number >> level) << level;
}

/// Whether coarser levels would still have fewer columns (or rows): not once there is one, or the two that meet at the
/// origin.
bool can_shrink(int first, int last, std::size_t level) {
  const int begin = first >> level, end = last >> level;
  return begin != end && !(begin == -1 && end == 0);
}

}  // namespace

std::filesystem::path folder_of(const PyramidTile& tile) {
  const std::filesystem::path patch = patch_name(tile.south_west);
  return tile.level == 0 ? patch : fmt::format("pyramid_{}", tile.level) / patch;
}

radar::GroundGrid texels_of(const PatchGrid& patches, const PyramidTile& tile) {
  if (tile.level == 0) return patches.texels_of(tile.south_west);
  const int span = 1 << tile.level;
  const double texel_m = patches.side_m() * span / static_cast<double>(tile_side);
  return {tile.south_west.x * patches.side_m(), (tile.south_west.y + span) * patches.side_m(), texel_m, tile_side,
          tile_side};
}

PyramidTiles::PyramidTiles(const PatchGrid& patches, const radar::Rectangle& extent) : patches_(patches) {
  const PatchBlock block = patches.block_over(extent);
  first_ = block.south_west;
  last_ = block.north_east;
  while (levels_ < highest_level && (can_shrink(first_.x, last_.x, levels_) || can_shrink(first_.y, last_.y, levels_)))
    ++levels_;
}

std::vector<PyramidTile> PyramidTiles::tiles(std::size_t level) const {
  std::vector<PyramidTile> tiles;
  const int step = 1 << level;
  for (int y = aligned(last_.y, level); y >= aligned(first_.y, level); y -= step) {
    for (int x = aligned(first_.x, level); x <= last_.x; x += step) tiles.push_back({level, {x, y}});
  }
  return tiles;
}

PyramidTile PyramidTiles::tile_over(PatchIndex patch, std::size_t level) const {
  return {level, {aligned(patch.x, level), aligned(patch.y, level)}};
}

std::optional<PyramidTile> PyramidTiles::parent_of(const PyramidTile& tile) const {
  if (tile.level >= levels_) return std::nullopt;
  return tile_over(tile.south_west, tile.level + 1);
}

bool PyramidTiles::has(const PyramidTile& tile) const {
  const int span = 1 << tile.level;
  return tile.south_west.x <= last_.x && tile.south_west.x + span > first_.x && tile.south_west.y <= last_.y &&
         tile.south_west.y + span > first_.y;
}

std::array<std::optional<PyramidTile>, 4> PyramidTiles::parts_of(const PyramidTile& tile) const {
  std::array<std::optional<PyramidTile>, 4> parts;
  const std::size_t below = tile.level - 1;
  const int half = 1 << below;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const PyramidTile part{below,
                           {tile.south_west.x + (i % 2 == 1 ? half : 0), tile.south_west.y + (i < 2 ? half : 0)}};
    if (has(part)) parts[i] = part;
  }
  return parts;
}

}  // namespace sigmascape::atlas
