#pragma once

#include <limits>

#include "sigmascape/base/vec.h"

namespace sigmascape::trace {

/// The level ground z = 0 and where it ends, in the frame of the rays: where terrain would end that a scene were traced
/// on. It is met from above alone.
struct LevelPlane {
  float west_m = 0.0F, south_m = 0.0F, east_m = 0.0F, north_m = 0.0F;

  /// How far along a ray; infinite where it passes.
  [[nodiscard]] float distance_m(Vec3f origin, Vec3f direction) const {
    const float ahead_m = -origin.z / direction.z;
    const float x = origin.x + direction.x * ahead_m, y = origin.y + direction.y * ahead_m;
    const bool comes_down = direction.z < 0.0F && origin.z > 0.0F;
    const bool is_within = x >= west_m && x <= east_m && y >= south_m && y <= north_m;
    return comes_down && is_within ? ahead_m : std::numeric_limits<float>::infinity();
  }
};

}  // namespace sigmascape::trace
