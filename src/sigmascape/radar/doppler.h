#pragma once

#include <cmath>

#include "sigmascape/base/vec.h"

namespace sigmascape::radar {

/// Where something is and how it moves at one moment, in the local frame.
struct Motion {
  Vec3d position;
  Vec3d velocity_mps = {};
};

/// How fast the distance between two grows: ṙ = (v₂ − v₁)·u, u from the first to the second.
[[nodiscard]] inline double range_rate_mps(const Motion& radar, const Motion& target) {
  const Vec3d away = target.position - radar.position;
  return dot(target.velocity_mps - radar.velocity_mps, away) / length(away);
}

/// f = −2 ṙ/λ: positive when they approach.                                  docs/physics/doppler.md, Eq. (1)
[[nodiscard]] inline double doppler_hz(double range_rate_mps, double wavelength_m) {
  return -2.0 * range_rate_mps / wavelength_m;
}

/// How fast the Doppler changes: −2 r̈/λ with r̈ = (|v|² − ṙ²)/r for even motions, v that of one seen from the other.
/// docs/physics/doppler.md, Eq. (2).
[[nodiscard]] inline double doppler_rate_hz_per_s(const Motion& radar, const Motion& target, double wavelength_m) {
  const double range_m = length(target.position - radar.position), rate = range_rate_mps(radar, target);
  const Vec3d relative = target.velocity_mps - radar.velocity_mps;
  return -2.0 * (dot(relative, relative) - rate * rate) / (range_m * wavelength_m);
}

/// The frequency as sampled once a pulse shows it: within one pulse repetition frequency from `first_hz`.
[[nodiscard]] inline double folded_hz(double frequency_hz, double first_hz, double pulse_repetition_hz) {
  return frequency_hz - pulse_repetition_hz * std::floor((frequency_hz - first_hz) / pulse_repetition_hz);
}

/// The angle between the course and the direction to a place, 0 to π, both on the map: a horizontal angle, as a beam's
/// is. What climbs or dives straight flies towards every place.
[[nodiscard]] inline double off_course_rad(Vec3d velocity_mps, Vec3d away) {
  return std::atan2(std::abs(velocity_mps.x * away.y - velocity_mps.y * away.x),
                    velocity_mps.x * away.x + velocity_mps.y * away.y);
}

/// Width on level ground, along constant range, of one Doppler cell of a coherent interval T, at horizontal speed v and
/// so far off the course φ: λ r/(2 v T sin φ). A vertical speed changes the Doppler of all ground at one range alike
/// and tells none of it apart. The width grows without bounds towards the course, where all of it has nearly one.
/// docs/physics/doppler.md, Eq. (3).
[[nodiscard]] inline double cross_range_resolution_m(double range_m, double wavelength_m, double horizontal_speed_mps,
                                                     double interval_s, double off_course_rad) {
  return wavelength_m * range_m / (2.0 * horizontal_speed_mps * interval_s * std::abs(std::sin(off_course_rad)));
}

/// The angle off the course below which sharpening by Doppler does not narrow a real beam of this width, at this angle
/// of depression: λ/(2 v T θ_b cos ψ) = sin φ. docs/physics/doppler.md, Eq. (4).
[[nodiscard]] inline double blind_wedge_rad(double wavelength_m, double horizontal_speed_mps, double interval_s,
                                            double beam_width_rad, double depression_rad) {
  const double cells_of_beam = 2.0 * horizontal_speed_mps * interval_s * beam_width_rad * std::cos(depression_rad);
  return std::asin(std::fmin(1.0, wavelength_m / cells_of_beam));
}

/// How far along the flight direction a broadside mover appears from where it is: −r ṙ/V, ṙ its own part of the range
/// rate; forward when it approaches.                                          docs/physics/doppler.md, Eq. (6)
[[nodiscard]] inline double mover_shift_m(double range_m, double own_range_rate_mps, double platform_speed_mps) {
  return -range_m * own_range_rate_mps / platform_speed_mps;
}

}  // namespace sigmascape::radar
