#pragma once

#include "sigmascape/base/vec.h"

namespace sigmascape::trace {

/// A flat face as it lies: its normal, of any length, and one over its area.
struct FacePlane {
  Vec3f normal;
  float inverse_area_per_m2 = 0.0F;
};

/// How an instance stands in the world: stretched along its axes, then turned.
struct Placement {
  float cos_yaw = 1.0F, sin_yaw = 0.0F;
  Vec3f inverse_scale{1.0F, 1.0F, 1.0F};
  float inverse_volume_scale = 1.0F;

  /// Normals transform by the inverse transpose: divide by the scale, then turn. Areas grow by how much that shortens
  /// them, times the growth of volumes.
  [[nodiscard]] FacePlane in_world(const FacePlane& face) const {
    const Vec3f& m = face.normal;
    const Vec3f n{m.x * inverse_scale.x, m.y * inverse_scale.y, m.z * inverse_scale.z};
    return {{n.x * cos_yaw + n.y * sin_yaw, -n.x * sin_yaw + n.y * cos_yaw, n.z},
            face.inverse_area_per_m2 * (inverse_volume_scale * length(m) / length(n))};
  }
};

}  // namespace sigmascape::trace
