#pragma once

#include <algorithm>
#include <array>

#include "sigmascape/base/vec.h"
#include "sigmascape/radar/ground_grid.h"

namespace sigmascape::radar {

[[nodiscard]] constexpr std::array<Vec2d, 4> corners_of(const Rectangle& r) {
  return {{{r.west_m, r.south_m}, {r.east_m, r.south_m}, {r.west_m, r.north_m}, {r.east_m, r.north_m}}};
}

/// From a place to the nearest point of a rectangle, 0 from within.
[[nodiscard]] inline double nearest_m(const Rectangle& r, Vec2d place) {
  return length(Vec2d{std::clamp(place.x, r.west_m, r.east_m), std::clamp(place.y, r.south_m, r.north_m)} - place);
}

/// From a place to the farthest corner.
[[nodiscard]] inline double farthest_m(const Rectangle& r, Vec2d place) {
  double farthest = 0.0;
  for (const Vec2d corner : corners_of(r)) farthest = std::max(farthest, length(corner - place));
  return farthest;
}

}  // namespace sigmascape::radar
