#include "sigmascape/render/obstacle_source.h"

#include <vector>

#include "sigmascape/render/part_of_tile.h"

namespace sigmascape::render {

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

void ObstacleSource::fill_tops(const atlas::TileAddress& tile, std::span<float> top_m) const {
  auto next = top_m.begin();
  for_each_square(tile, [&next](const radar::Obstacle& obstacle) {
    *next++ = PackedObstacle::packed(obstacle).unpacked().top_m();
  });
}

}  // namespace sigmascape::render
