#pragma once

#include <algorithm>
#include <cmath>

#include "sigmascape/base/vec.h"

namespace sigmascape::terrain {

// A square of obstacles is as high above the ground under each of its points as its roof is, at most, anywhere within
// it. So what stands on a roof may lie below the top of its square, and a line of sight that leaves it below those of
// the squares next to it.

/// Squares of a roof know its height no better: edges and slight slopes, and the rounding of what is stored.
inline constexpr double roof_tolerance_m = 0.3;
/// Nor is there doubt about it farther away than so many squares.
inline constexpr double most_doubtful_squares = 32.0;

/// By how much more, of their own width, squares over ground or of a roof with that normal may be higher than what
/// stands in them.
[[nodiscard]] inline double rise_across(Vec3d normal) {
  return (std::abs(normal.x) + std::abs(normal.y)) / normal.z;
}

/// What stands so high above the ground of a place is known to be above the squares of its house no better than to
/// this; 0 where it stands on no roof. The roof may be that of a square beside its own: one that is covered by less
/// than half has none. `top_m(place)`: of the solid top of the square there, above its ground; `ground_doubt_m`: by how
/// much the height of the ground may be wrong.
template <typename TopAt>
[[nodiscard]] double doubt_about_roof_m(Vec2d place, double above_m, Vec3d ground_normal, double square_m,
                                        const TopAt& top_m, double ground_doubt_m = 0.0) {
  const double doubt_m = roof_tolerance_m + square_m * rise_across(ground_normal);
  for (const double north : {-1.0, 0.0, 1.0}) {
    for (const double east : {-1.0, 0.0, 1.0}) {
      const double roof_m = top_m(place + Vec2d{east, north} * square_m);
      if (roof_m > 0.0 && std::abs(above_m - roof_m) <= doubt_m + ground_doubt_m) return doubt_m;
    }
  }
  return 0.0;
}

/// What is left of that so far before the place, along a line of sight that rises so much a metre towards the radar:
/// what it has climbed no doubt takes from it.
[[nodiscard]] inline double doubt_left_m(double doubt_m, double before_m, double rise, double square_m) {
  if (before_m >= most_doubtful_squares * square_m) return 0.0;
  return std::max(0.0, doubt_m - before_m * std::max(0.0, rise));
}

}  // namespace sigmascape::terrain
