#pragma once

#include <cmath>

namespace sigmascape::live {

/// arctan for |u| ≤ 1, by half the angle and the power series; error below 1e-7. Without branches, for loops over rows.
inline float small_arc(float u) {
  const float t = u / (1.0F + std::sqrt(1.0F + u * u));
  const float s = t * t;
  const float series =
      1.0F -
      s * (1.0F / 3 - s * (1.0F / 5 - s * (1.0F / 7 - s * (1.0F / 9 - s * (1.0F / 11 - s * (1.0F / 13 - s / 15))))));
  return 2.0F * t * series;
}

}  // namespace sigmascape::live
