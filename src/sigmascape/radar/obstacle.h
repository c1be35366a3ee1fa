#pragma once

#include <algorithm>
#include <cstddef>

#include "sigmascape/base/array2d.h"
#include "sigmascape/base/vec.h"
#include "sigmascape/radar/ground_grid.h"
#include "sigmascape/radar/value_at.h"

namespace sigmascape::radar {

/// What stands on a square of ground, as far as it hides what is behind it. Heights are above that ground.
struct Obstacle {
  float solid_top_m = 0.0F;  ///< of what lets nothing through; 0 where there is none
  float crown_base_m = 0.0F;
  float crown_top_m = 0.0F;             ///< of what lets a part through, from its base up; 0 where there is none
  float crown_extinction_per_m = 0.0F;  ///< optical depth of a metre of line of sight within: e^−depth is not hidden

  friend constexpr bool operator==(const Obstacle&, const Obstacle&) = default;
  [[nodiscard]] constexpr float top_m() const { return std::max(solid_top_m, crown_top_m); }
};

/// What stands for four obstacles of neighbouring squares on the square that they form: for solids the height that
/// keeps the shadowed area (the greatest of each row along the line of sight, meant over rows; and that meant over both
/// ways of looking), for crowns the extinction between mean base and mean top, weighted by their depths upwards, with
/// which as much passes as between the four (lines_across.h), meant over looking along rows, columns and upwards. Each
/// of the four is `side_m` wide.
[[nodiscard]] Obstacle merged(const Obstacle& north_west, const Obstacle& north_east, const Obstacle& south_west,
                              const Obstacle& south_east, double side_m);

/// The obstacles of an area, square by square.
struct ObstacleMap {
  GroundGrid grid;
  Array2D<Obstacle> obstacles;  ///< [column, row]

  /// What stands at a point; nothing outside the grid.
  [[nodiscard]] Obstacle at(Vec2d point) const { return value_at(grid, obstacles, point); }
};

/// Half the columns and rows, each square what stands for the four it covers. Columns and rows must be even.
[[nodiscard]] ObstacleMap halved(const ObstacleMap& finer);

}  // namespace sigmascape::radar
