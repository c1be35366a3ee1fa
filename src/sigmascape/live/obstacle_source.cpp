#include "sigmascape/live/obstacle_source.h"

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

#include "sigmascape/atlas/ground_layers.h"
#include "sigmascape/live/part_of_tile.h"
#include "sigmascape/radar/answering_tops.h"

namespace sigmascape::live {

template <typename Each>
std::size_t ObstacleSource::for_each_square(const atlas::TileAddress& tile, Each each) const {
  std::vector<radar::Obstacle> obstacles(ObstaclePage::squares);
  atlas::TileAddress from = tile;
  while (from.level < levels() && !tiles_.read(from, obstacles)) from = from.parent();
  const bool nothing = from.level >= levels();
  const PartOfTile part = PartOfTile::of(tile, from);
  for (std::uint32_t row = 0; row < atlas::tile_side; ++row) {
    for (std::uint32_t column = 0; column < atlas::tile_side; ++column) {
      each(nothing ? radar::Obstacle{} : obstacles[part.index_of(row, column)]);
    }
  }
  return from.level - tile.level;
}

bool ObstacleSource::fill(ObstaclePage& page) const {
  page.of.clear();
  page.of.reserve(ObstaclePage::squares);
  page.levels_lacking = for_each_square(
      page.key, [&page](const radar::Obstacle& obstacle) { page.of.push_back(PackedObstacle::packed(obstacle)); });
  return true;
}

ObstacleSource::Standing ObstacleSource::standing_on(const atlas::TileAddress& tile) const {
  Standing standing{.top_m = Array2D<float>(atlas::tile_side, atlas::tile_side)};
  auto next = standing.top_m.values().begin();
  standing.levels_lacking =
      for_each_square(tile, [&next](const radar::Obstacle& obstacle) { *next++ = obstacle.top_m(); });
  return standing;
}

bool ObstacleSource::can_be_read(atlas::TileAddress tile, std::size_t levels) const {
  std::vector<radar::Obstacle> obstacles(ObstaclePage::squares);
  for (std::size_t up = 0; up < levels; ++up, tile = tile.parent()) {
    if (tiles_.read(tile, obstacles)) return true;
  }
  return false;
}

Shortage ObstacleSource::fill_tops(const atlas::TileAddress& tile, std::span<float> top_m) const {
  constexpr std::size_t side = atlas::tile_side;
  const double cell_m = atlas::texel_side_m(description().patches, tile.level);
  // What stands beyond the next tile does not reach over it.
  const std::size_t margin = std::min(radar::layover_squares(static_cast<double>(tallest_m()), cell_m), side);
  Array2D<float> about(side + 2 * margin, side + 2 * margin);
  std::vector<std::pair<atlas::TileAddress, std::size_t>> lacking;
  for (int down = -1; down <= 1; ++down) {
    for (int across = -1; across <= 1; ++across) {
      const atlas::TileAddress here{tile.level, tile.x + across, tile.y - down};
      const auto [tops, levels_lacking] = standing_on(here);
      if (levels_lacking > 0) lacking.emplace_back(here, levels_lacking);
      const std::size_t first_column = across < 0 ? side - margin : 0, first_row = down < 0 ? side - margin : 0;
      const std::size_t columns = across == 0 ? side : margin, rows = down == 0 ? side : margin;
      const std::size_t to_column = across < 0 ? 0 : margin + (across > 0 ? side : 0);
      const std::size_t to_row = down < 0 ? 0 : margin + (down > 0 ? side : 0);
      for (std::size_t row = 0; row < rows; ++row) {
        std::ranges::copy(tops.row(first_row + row).subspan(first_column, columns),
                          about.row(to_row + row).begin() + static_cast<std::ptrdiff_t>(to_column));
      }
    }
  }
  const Array2D<float> overlying_m = radar::overlying_tops_m(about, cell_m);
  for (std::size_t row = 0; row < side; ++row) {
    std::ranges::copy(overlying_m.row(margin + row).subspan(margin, side),
                      top_m.begin() + static_cast<std::ptrdiff_t>(row * side));
  }
  if (lacking.empty()) return {};
  return [this, lacking] {
    return std::ranges::any_of(lacking, [this](const auto& one) { return can_be_read(one.first, one.second); });
  };
}

}  // namespace sigmascape::live
