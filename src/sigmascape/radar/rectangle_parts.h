#pragma once

#include <algorithm>

#include "sigmascape/radar/ground_grid.h"

namespace sigmascape::radar {

/// The rectangle and all within so much of a side of it; of a negative number, what is left of it.
[[nodiscard]] constexpr Rectangle widened(const Rectangle& r, double by_m) {
  return {r.west_m - by_m, r.south_m - by_m, r.east_m + by_m, r.north_m + by_m};
}

/// The same rectangle elsewhere.
[[nodiscard]] constexpr Rectangle moved(const Rectangle& r, Vec2d by) {
  return {r.west_m + by.x, r.south_m + by.y, r.east_m + by.x, r.north_m + by.y};
}

/// The least rectangle that holds one and a point.
[[nodiscard]] constexpr Rectangle with_point(const Rectangle& r, Vec2d point) {
  return {std::min(r.west_m, point.x), std::min(r.south_m, point.y), std::max(r.east_m, point.x),
          std::max(r.north_m, point.y)};
}

/// The least rectangle that holds two.
[[nodiscard]] constexpr Rectangle joined(const Rectangle& a, const Rectangle& b) {
  return with_point(with_point(a, {b.west_m, b.south_m}), {b.east_m, b.north_m});
}

/// What two rectangles have in common: one whose east lies west of its west, or north south, where that is nothing.
[[nodiscard]] constexpr Rectangle common_part(const Rectangle& a, const Rectangle& b) {
  return {std::max(a.west_m, b.west_m), std::max(a.south_m, b.south_m), std::min(a.east_m, b.east_m),
          std::min(a.north_m, b.north_m)};
}

/// Whether they have a point in common, be it of their edges.
[[nodiscard]] constexpr bool meet(const Rectangle& a, const Rectangle& b) {
  const Rectangle common = common_part(a, b);
  return common.east_m >= common.west_m && common.north_m >= common.south_m;
}

/// Whether all of one lies within another, be it at its edges.
[[nodiscard]] constexpr bool holds(const Rectangle& outer, const Rectangle& inner) {
  return outer.contains({inner.west_m, inner.south_m}) && outer.contains({inner.east_m, inner.north_m});
}

}  // namespace sigmascape::radar
