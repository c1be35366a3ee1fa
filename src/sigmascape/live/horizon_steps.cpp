#include "sigmascape/live/horizon_steps.h"

#include <algorithm>
#include <cmath>

#include "sigmascape/base/vector_targets.h"
#include "sigmascape/live/lesser_greater.h"
#include "sigmascape/radar/look.h"
#include "sigmascape/terrain/obstacle_sweep.h"

namespace sigmascape::live {
namespace {

/// The squares of obstacles that the steps fall into, numbered tile by tile (ObstacleMosaic::at).
SIGMASCAPE_VECTOR_TARGETS
void look_up_squares(HorizonSteps& steps, float first_column, float first_row, float columns_a_step, float rows_a_step,
                     std::int32_t tiles_across, std::int32_t tiles_down) {
  constexpr auto side = static_cast<std::int32_t>(atlas::tile_side);
  const auto width = static_cast<float>(tiles_across * side), height = static_cast<float>(tiles_down * side);
  SIGMASCAPE_INDEPENDENT_TURNS
  for (std::size_t i = 0; i < steps.count; ++i) {
    const auto k = static_cast<float>(static_cast<std::int32_t>(i));
    const float across = first_column + k * columns_a_step, down = first_row + k * rows_a_step;
    const bool inside = (across >= 0.0F) & (down >= 0.0F) & (across < width) & (down < height);
    const auto column = static_cast<std::int32_t>(lesser(greater(across, 0.0F), width - 1.0F));
    const auto row = static_cast<std::int32_t>(lesser(greater(down, 0.0F), height - 1.0F));
    const std::int32_t tile = row / side * tiles_across + column / side;
    steps.square[i] = inside ? (tile * side + row % side) * side + column % side : -1;
  }
}

}  // namespace

SIGMASCAPE_VECTOR_TARGETS
void look_up_ground(HorizonSteps& steps, const StepsAlong& eastward, const StepsAlong& southward, const float* height_m,
                    std::int32_t columns, float radar_height_m, float drop_per_square_m) {
  SIGMASCAPE_INDEPENDENT_TURNS
  for (std::size_t i = 0; i < steps.count; ++i) {
    const auto k = static_cast<float>(static_cast<std::int32_t>(i));
    const float distance = steps.first_m + k * steps.step_m;
    const float across = eastward.first + k * eastward.a_step;
    const float down = southward.first + k * southward.a_step;
    const float x = lesser(greater(across, eastward.begin), eastward.end);
    const float y = lesser(greater(down, southward.begin), southward.end);
    const auto left = std::min(static_cast<std::int32_t>(x), eastward.last_cell);
    const auto upper = std::min(static_cast<std::int32_t>(y), southward.last_cell);
    const float u = x - static_cast<float>(left), v = y - static_cast<float>(upper);
    const std::int32_t index = (upper - southward.first_node) * columns + left - eastward.first_node;
    const float north = height_m[index] + u * (height_m[index + 1] - height_m[index]);
    const float south = height_m[index + columns] + u * (height_m[index + columns + 1] - height_m[index + columns]);
    const float height = north + v * (south - north);
    const float slope = (height - radar_height_m) / distance - drop_per_square_m * distance;
    // A hair's breadth outside is inside: rounding must not tear the edge.
    const float outside = greater(std::abs(across - x), std::abs(down - y));
    steps.distance_m[i] = distance;
    steps.slope[i] = outside <= 1e-3F ? slope : no_ground;
  }
}

void look_up_obstacles(HorizonSteps& steps, const ObstacleMosaic& obstacles, float first_column, float first_row,
                       float columns_a_step, float rows_a_step) {
  look_up_squares(steps, first_column, first_row, columns_a_step, rows_a_step,
                  static_cast<std::int32_t>(obstacles.block().across),
                  static_cast<std::int32_t>(obstacles.block().down));
  // Squares are far apart in memory: read before the first step is taken, none waits for what is made of the one before
  // it.
  for (std::size_t i = 0; i < steps.count; ++i) {
    steps.obstacle[i] = steps.square[i] < 0 ? PackedObstacle{} : obstacles.at(steps.square[i]);
  }
}

double HorizonSteps::crown_depth(std::size_t i, double stride_m, double along_slope) const {
  const PackedObstacle packed = obstacle[i];
  if (!(distance_m[i] > 0.0F) || slope[i] == no_ground || packed.crown_top == 0) return 0.0;
  const radar::Obstacle standing = packed.unpacked();
  const double above_ground_m = (along_slope - static_cast<double>(slope[i])) * static_cast<double>(distance_m[i]);
  const double part = terrain::part_within(standing, above_ground_m, 0.5 * stride_m * std::abs(along_slope));
  return part * static_cast<double>(standing.crown_extinction_per_m) * stride_m * std::hypot(1.0, along_slope);
}

double HorizonSteps::solid_slope(std::size_t i) const {
  const PackedObstacle packed = obstacle[i];
  if (!(distance_m[i] > 0.0F) || slope[i] == no_ground || packed.solid_top == 0) return static_cast<double>(no_ground);
  return static_cast<double>(slope[i] + packed.unpacked().solid_top_m / distance_m[i]);
}

}  // namespace sigmascape::live
