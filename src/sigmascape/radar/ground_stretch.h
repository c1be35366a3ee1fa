#pragma once

#include <algorithm>
#include <array>
#include <limits>

#include "sigmascape/base/vec.h"
#include "sigmascape/radar/ground_grid.h"

namespace sigmascape::radar {

/// A stretch of a way over the ground, as distances from where the way begins. None where it ends before it begins.
struct GroundStretch {
  double begin_m = 0.0;
  double end_m = std::numeric_limits<double>::infinity();

  [[nodiscard]] constexpr bool empty() const { return !(begin_m <= end_m); }
};

/// The part of the way from `origin` along the unit vector `direction` that lies in a rectangle, its edges included.
[[nodiscard]] inline GroundStretch stretch_within(const Rectangle& ground, Vec2d origin, Vec2d direction) {
  constexpr GroundStretch none{1.0, 0.0};
  GroundStretch stretch;
  for (const auto& [start, rise, low, high] : {std::array{origin.x, direction.x, ground.west_m, ground.east_m},
                                               std::array{origin.y, direction.y, ground.south_m, ground.north_m}}) {
    if (rise == 0.0) {
      if (start < low || start > high) return none;
      continue;
    }
    const auto [near_m, far_m] = std::minmax({(low - start) / rise, (high - start) / rise});
    stretch = {std::max(stretch.begin_m, near_m), std::min(stretch.end_m, far_m)};
  }
  return stretch;
}

}  // namespace sigmascape::radar
