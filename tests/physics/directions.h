#pragma once

#include <cmath>

#include "sigmascape/base/vec.h"

namespace sigmascape::physics_test {

inline constexpr Vec3f up{0.0F, 0.0F, 1.0F};

inline Vec3f direction_at(double incidence_rad, double azimuth_rad = 0.0) {
  return Vec3d{std::sin(incidence_rad) * std::cos(azimuth_rad), std::sin(incidence_rad) * std::sin(azimuth_rad),
               std::cos(incidence_rad)}
      .to<float>();
}

}  // namespace sigmascape::physics_test
