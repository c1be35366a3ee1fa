#pragma once

#include <cmath>

#include "sigmascape/base/units.h"
#include "sigmascape/radar/radar.h"

namespace sigmascape::radar {

/// Flies north at 200 m/s with a 2° beam at a wavelength of 3 cm; a rectangular window, 0.8859 cells wide.
inline Radar flying_north(Mode mode) {
  Radar radar;
  radar.frequency_hz = speed_of_light_mps / 0.03;
  radar.velocity_mps = {0.0, 200.0, 0.0};
  radar.beam_width_rad = radians_from_deg(2.0);
  radar.waveform.window.shape = WindowShape::Rectangular;
  radar.mode = mode;
  return radar;
}

/// A place 10 km away, so far off the nose to the right.
inline Vec3d place_at(double squint_deg) {
  const double squint = radians_from_deg(squint_deg);
  return {10e3 * std::sin(squint), 10e3 * std::cos(squint), 0.0};
}

/// Level ground 10 km away, so far off the nose on the map and seen at this depression from the origin.
inline Vec3d ground_at(double off_course_deg, double depression_deg) {
  const double ground_m = 10e3 * std::cos(radians_from_deg(depression_deg)), off = radians_from_deg(off_course_deg);
  return {ground_m * std::sin(off), ground_m * std::cos(off), -10e3 * std::sin(radians_from_deg(depression_deg))};
}

}  // namespace sigmascape::radar
