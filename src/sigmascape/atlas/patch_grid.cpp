#include "sigmascape/atlas/patch_grid.h"

#include <bit>
#include <cmath>
#include <fmt/format.h>

#include "sigmascape/base/error.h"

namespace sigmascape::atlas {

std::size_t PatchGrid::stored_levels() const {
  return static_cast<std::size_t>(std::bit_width(texels_per_side / tile_side));
}

radar::GroundGrid PatchGrid::texels_of(PatchIndex patch) const {
  return {patch.x * side_m(), (patch.y + 1) * side_m(), texel_m, texels_per_side, texels_per_side};
}

PatchIndex PatchGrid::patch_at(Vec2d point_m) const {
  return {static_cast<int>(std::floor(point_m.x / side_m())), static_cast<int>(std::floor(point_m.y / side_m()))};
}

std::size_t PatchBlock::columns() const {
  const int columns = north_east.x - south_west.x + 1;
  return static_cast<std::size_t>(columns);
}

std::size_t PatchBlock::rows() const {
  const int rows = north_east.y - south_west.y + 1;
  return static_cast<std::size_t>(rows);
}

PatchIndex PatchBlock::operator[](std::size_t number) const {
  return {south_west.x + static_cast<int>(number % columns()), north_east.y - static_cast<int>(number / columns())};
}

PatchBlock PatchGrid::block_over(const radar::Rectangle& rectangle) const {
  if (!(rectangle.width_m() > 0.0 && rectangle.height_m() > 0.0)) return {};
  // Sides of decimal texels are no binary fractions: what ends on a patch's edge but for rounding ends there.
  constexpr double slack = 1e-9;
  const auto begins_in = [&](double edge_m) { return static_cast<int>(std::floor(edge_m / side_m() + slack)); };
  const auto ends_before = [&](double edge_m) { return static_cast<int>(std::ceil(edge_m / side_m() - slack)); };
  return {{begins_in(rectangle.west_m), begins_in(rectangle.south_m)},
          {ends_before(rectangle.east_m) - 1, ends_before(rectangle.north_m) - 1}};
}

std::vector<PatchIndex> PatchGrid::covering(const radar::Rectangle& rectangle) const {
  const PatchBlock block = block_over(rectangle);
  std::vector<PatchIndex> patches(block.size());
  for (std::size_t number = 0; number < patches.size(); ++number) patches[number] = block[number];
  return patches;
}

void check(const PatchGrid& grid, std::string_view where) {
  if (!(grid.texel_m > 0.0 && grid.texel_m <= 1e6)) {
    throw Error(fmt::format("{}, texel_m", where), fmt::format("{:g} is out of range", grid.texel_m),
                "give the side of a texel in metres, above 0");
  }
  const bool fits = std::has_single_bit(grid.texels_per_side) && grid.texels_per_side >= tile_side &&
                    grid.texels_per_side <= most_texels_per_side;
  if (!fits) {
    throw Error(fmt::format("{}, texels_per_side", where), fmt::format("{} is not possible", grid.texels_per_side),
                fmt::format("give 256, 512, 1024 … up to {}", most_texels_per_side));
  }
}

}  // namespace sigmascape::atlas
