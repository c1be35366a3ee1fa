#pragma once

#include <cmath>

#include "sigmascape/base/units.h"
#include "sigmascape/base/vec.h"

namespace sigmascape {

/// The normal of level surfaces.
inline constexpr Vec3f up{0.0F, 0.0F, 1.0F};

/// Away from them.
inline Vec3f direction(double incidence_deg, double azimuth_deg = 0.0) {
  const double theta = radians_from_deg(incidence_deg);
  const double phi = radians_from_deg(azimuth_deg);
  return Vec3d{std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)}.to<float>();
}

}  // namespace sigmascape
