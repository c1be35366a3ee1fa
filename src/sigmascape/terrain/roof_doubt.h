#pragma once

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

}  // namespace sigmascape::terrain
