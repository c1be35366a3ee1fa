#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "sigmascape/live/obstacle_mosaic.h"

namespace sigmascape::live {

/// So many are looked up at once.
inline constexpr std::size_t steps_together = 256;
/// The slope of a step where the lattice has no ground.
inline constexpr float no_ground = -1e30F;
/// Single precision leaves this much doubt in a slope.
inline constexpr double slope_doubt = 1e-6;

/// Some steps along a direction, on the lattice of the terrain and on that of obstacles.
struct HorizonSteps {
  std::size_t count = 0;
  float first_m = 0.0F, step_m = 1.0F;
  alignas(64) std::array<float, steps_together> distance_m, slope;
  alignas(64) std::array<std::int32_t, steps_together> square;  // of the obstacles; −1 outside
  std::array<PackedObstacle, steps_together> obstacle;

  /// Optical depth of what stands at step i, `stride_m` long, on a line of sight under `along_slope`.
  [[nodiscard]] double crown_depth(std::size_t i, double stride_m, double along_slope) const;
  /// Of the line of sight to the top of what is solid there.
  [[nodiscard]] double solid_slope(std::size_t i) const;
};

/// Where steps lie along one side of a lattice, in its nodes, counted from a node of its own just before all of them:
/// which piece of the lattice is at hand makes no difference to a bit.
struct StepsAlong {
  float first = 0.0F, a_step = 0.0F;
  // The piece, counted from the same node.
  float begin = 0.0F, end = 0.0F;  // outer nodes
  std::int32_t first_node = 0, last_cell = 0;

  StepsAlong(double from, double nodes_a_step, std::size_t steps, std::int64_t piece_begin, std::size_t piece_nodes)
      : a_step(static_cast<float>(nodes_a_step)) {
    const double node = std::floor(std::min(from, from + nodes_a_step * static_cast<double>(steps))) - 1.0;
    first = static_cast<float>(from - node);
    // What is farther away is outside as well, and floats count no farther node by node.
    constexpr double far_outside = 1 << 23;
    first_node =
        static_cast<std::int32_t>(std::clamp(static_cast<double>(piece_begin) - node, -far_outside, far_outside));
    last_cell = first_node + static_cast<std::int32_t>(piece_nodes) - 2;
    begin = static_cast<float>(first_node);
    end = static_cast<float>(last_cell + 1);
  }
};

/// Slopes of the lines of sight to the bilinear ground under the steps.
void look_up_ground(HorizonSteps& steps, const StepsAlong& eastward, const StepsAlong& southward, const float* height_m,
                    std::int32_t columns, float radar_height_m, float drop_per_square_m);

/// What stands where the steps fall, `first_column` and `first_row` in squares of the mosaic.
void look_up_obstacles(HorizonSteps& steps, const ObstacleMosaic& obstacles, float first_column, float first_row,
                       float columns_a_step, float rows_a_step);

}  // namespace sigmascape::live
