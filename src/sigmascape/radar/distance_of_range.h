#pragma once

#include <cmath>

#include "sigmascape/radar/curved_earth.h"

namespace sigmascape::radar {

/// The distance along sea level to a point of that height whose slant range is known: CurvedEarth::slant_range_m turned
/// round (docs/physics/curved_earth.md, Eq. (4)). 0 where even what is straight below is farther away.
[[nodiscard]] inline double distance_of_range_m(const CurvedEarth& earth, double radar_height_m, double point_height_m,
                                                double slant_range_m) {
  const double c = earth.curvature_per_m(), climb_m = radar_height_m - point_height_m;
  const double chord2_m2 =
      (slant_range_m * slant_range_m - climb_m * climb_m) / (1.0 + c * radar_height_m) / (1.0 + c * point_height_m);
  const double chord_m = std::sqrt(std::fmax(chord2_m2, 0.0)), half_sine = 0.5 * c * chord_m;
  // asin x / x; the series, good to the last digit up to a hundredth, for Earths that are flat or nearly so.
  const double square = half_sine * half_sine;
  const double stretch = half_sine < 0.01
                             ? 1.0 + square / 6.0 * (1.0 + square * 9.0 / 20.0 * (1.0 + square * 25.0 / 42.0))
                             : std::asin(std::fmin(half_sine, 1.0)) / half_sine;
  return chord_m * stretch;
}

}  // namespace sigmascape::radar
