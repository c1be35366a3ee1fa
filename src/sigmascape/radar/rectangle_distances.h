#pragma once

#include <algorithm>
#include <array>

#include "sigmascape/base/vec.h"
#include "sigmascape/radar/ground_grid.h"

namespace sigmascape::radar {

[[nodiscard]] constexpr std::array<Vec2d, 4> corners_of(const Rectangle& r) {
  return {{{r.west_m, r.south_m}, {r.east_m, r.south_m}, {r.west_m, r.north_m}, {r.east_m, r.north_m}}};
}

/// The same at a height.
[[nodiscard]] constexpr std::array<Vec3d, 4> corners_of(const Rectangle& r, double height_m) {
  std::array<Vec3d, 4> corners{};
  std::ranges::transform(corners_of(r), corners.begin(), [&](Vec2d corner) {
    return Vec3d{corner.x, corner.y, height_m};
  });
  return corners;
}

/// The point of a rectangle that is nearest to a place: the place itself from within.
[[nodiscard]] constexpr Vec2d nearest_point(const Rectangle& r, Vec2d place) {
  return {std::clamp(place.x, r.west_m, r.east_m), std::clamp(place.y, r.south_m, r.north_m)};
}

/// From a place to the nearest point of a rectangle, 0 from within.
[[nodiscard]] inline double nearest_m(const Rectangle& r, Vec2d place) {
  return length(nearest_point(r, place) - place);
}

/// From a place to the farthest corner.
[[nodiscard]] inline double farthest_m(const Rectangle& r, Vec2d place) {
  double farthest = 0.0;
  for (const Vec2d corner : corners_of(r)) farthest = std::max(farthest, length(corner - place));
  return farthest;
}

/// The least and the most that anything has over a rectangle which grows evenly over the ground: `measure(place)`.
template <typename Measure>
[[nodiscard]] std::array<double, 2> span_over(const Rectangle& r, const Measure& measure) {
  std::array<double, 4> values{};
  std::ranges::transform(corners_of(r), values.begin(), measure);
  return {std::ranges::min(values), std::ranges::max(values)};
}

}  // namespace sigmascape::radar
