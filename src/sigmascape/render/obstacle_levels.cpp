#include "sigmascape/render/obstacle_levels.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sigmascape/atlas/obstacle_file.h"

namespace sigmascape::render {
namespace {

using radar::Obstacle;

std::uint16_t in_steps(float value, float per_unit) {
  constexpr auto most = static_cast<float>(std::numeric_limits<std::uint16_t>::max());
  return static_cast<std::uint16_t>(std::lround(std::clamp(value * per_unit, 0.0F, most)));
}

ObstacleLevel empty_level(const radar::GroundGrid& finest, std::size_t level) {
  radar::GroundGrid grid = finest;
  grid.cell_m *= static_cast<double>(std::size_t{1} << level);
  grid.columns >>= level;
  grid.rows >>= level;
  return {grid, std::vector<PackedObstacle>(grid.columns * grid.rows)};
}

/// Puts a patch's obstacles in their place on the map of all.
void place(const Array2D<Obstacle>& patch, std::size_t first_column, std::size_t first_row, ObstacleLevel& level) {
  for (std::size_t row = 0; row < patch.rows(); ++row) {
    for (std::size_t column = 0; column < patch.columns(); ++column) {
      level.of[(first_row + row) * level.grid.columns + first_column + column] =
          PackedObstacle::packed(patch(column, row));
    }
  }
}

}  // namespace

PackedObstacle PackedObstacle::packed(const Obstacle& obstacle) {
  return {in_steps(obstacle.solid_top_m, per_height_m), in_steps(obstacle.crown_base_m, per_height_m),
          in_steps(obstacle.crown_top_m, per_height_m), in_steps(obstacle.crown_extinction_per_m, per_extinction)};
}

ObstacleLevels::ObstacleLevels(const atlas::Store& atlas, std::size_t budget_bytes) {
  const atlas::PatchGrid& patches = atlas.description().patches;
  const auto covering = patches.covering(atlas.description().extent);
  const radar::GroundGrid first = patches.texels_of(covering.front());
  radar::GroundGrid finest = first;
  finest.columns *= static_cast<std::size_t>(covering.back().x - covering.front().x + 1);
  finest.rows *= static_cast<std::size_t>(covering.front().y - covering.back().y + 1);

  // All levels from one on take 4/3 of the memory of that one.
  std::size_t left_out = 0;
  while ((finest.columns * finest.rows >> (2 * left_out)) * sizeof(PackedObstacle) * 4 / 3 > budget_bytes &&
         patches.texels_per_side >> (left_out + 1) > 0) {
    ++left_out;
  }
  const auto most_levels = static_cast<std::size_t>(std::log2(static_cast<double>(patches.texels_per_side)));
  for (std::size_t level = left_out; level <= most_levels; ++level) levels_.push_back(empty_level(finest, level));

  for (const atlas::PatchIndex& patch : covering) {
    Array2D<Obstacle> obstacles = atlas::read_obstacles(atlas, patch);
    for (const Obstacle& obstacle : obstacles.values()) tallest_m_ = std::max(tallest_m_, obstacle.top_m());
    const auto column = static_cast<std::size_t>(patch.x - covering.front().x);
    const auto row = static_cast<std::size_t>(covering.front().y - patch.y);
    for (std::size_t level = 0; level <= most_levels; ++level) {
      if (level > 0) obstacles = radar::halved(obstacles);
      if (level < left_out) continue;
      place(obstacles, column * obstacles.columns(), row * obstacles.rows(), levels_[level - left_out]);
    }
  }
}

std::size_t ObstacleLevels::bytes() const {
  std::size_t sum = 0;
  for (const ObstacleLevel& level : levels_) sum += level.of.size() * sizeof(PackedObstacle);
  return sum;
}

const ObstacleLevel& ObstacleLevels::level_for(double most_m) const {
  const auto larger = std::ranges::find_if(levels_, [most_m](const auto& level) { return level.grid.cell_m > most_m; });
  return larger == levels_.begin() ? levels_.front() : *(larger - 1);
}

}  // namespace sigmascape::render
