#include "sigmascape/terrain/height_tile.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace sigmascape::terrain {

float HeightTile::at(double column, double row) const {
  constexpr double last = static_cast<double>(cells);
  const double across = std::clamp(column, 0.0, last), down = std::clamp(row, 0.0, last);
  const auto i = std::min(static_cast<std::size_t>(across), cells - 1),
             j = std::min(static_cast<std::size_t>(down), cells - 1);
  const auto u = static_cast<float>(across - static_cast<double>(i)),
             v = static_cast<float>(down - static_cast<double>(j));
  const float* const north_west = height_m.data() + j * nodes + i;
  const float north = (1.0F - u) * north_west[0] + u * north_west[1];
  const float south = (1.0F - u) * north_west[nodes] + u * north_west[nodes + 1];
  return (1.0F - v) * north + v * south;
}

PyramidLayout PyramidLayout::covering(const radar::Rectangle& rectangle, double spacing_m) {
  const auto tiles = [&](double size_m) {
    const double count = std::ceil(size_m / (spacing_m * static_cast<double>(HeightTile::cells)) - 1e-9);
    return static_cast<std::uint32_t>(std::max(count, 1.0));
  };
  return {rectangle.west_m, rectangle.north_m, spacing_m, tiles(rectangle.width_m()), tiles(rectangle.height_m())};
}

int PyramidLayout::levels() const {
  return std::bit_width(std::max(tiles_across, tiles_down) - 1) + 1;
}

bool PyramidLayout::has(TileKey key) const {
  return key.level >= 0 && key.level < levels() && key.column < across(key.level) && key.row < down(key.level);
}

radar::Rectangle PyramidLayout::extent() const {
  const double side_m = spacing_m * static_cast<double>(HeightTile::cells);
  return {west_m, north_m - side_m * tiles_down, west_m + side_m * tiles_across, north_m};
}

radar::Rectangle PyramidLayout::extent_of(TileKey key) const {
  const double side_m = spacing_at(key.level) * static_cast<double>(HeightTile::cells);
  const double west = west_m + side_m * key.column, north = north_m - side_m * key.row;
  return {west, north - side_m, west + side_m, north};
}

}  // namespace sigmascape::terrain
