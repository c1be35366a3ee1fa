#pragma once

#include <cmath>

#include "sigmascape/base/vec.h"

namespace sigmascape::trace {

/// The horizontal part of a direction, of unit length; nothing straight up.
[[nodiscard]] inline Vec2d level_part(Vec3d direction) {
  // Asked once a path: std::hypot would take several times as long to no gain, all being of order one.
  const double horizontal = std::sqrt(direction.x * direction.x + direction.y * direction.y);
  return horizontal > 0.0 ? Vec2d{direction.x / horizontal, direction.y / horizontal} : Vec2d{};
}

}  // namespace sigmascape::trace
