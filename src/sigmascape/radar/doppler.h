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

/// Cross-range that one Doppler cell of a coherent interval T is wide at squint θ off the flight direction:
/// λ r / (2 v T sin θ). It grows without bounds towards the nose, where all ground has nearly one Doppler.
/// docs/physics/doppler.md, Eq. (3).
[[nodiscard]] inline double cross_range_resolution_m(double range_m, double wavelength_m, double speed_mps,
                                                     double interval_s, double squint_rad) {
  return wavelength_m * range_m / (2.0 * speed_mps * interval_s * std::abs(std::sin(squint_rad)));
}

/// The squint below which sharpening by Doppler does not narrow a real beam of this width: λ/(2 v T θ_b) = sin θ.
/// docs/physics/doppler.md, Eq. (4).
[[nodiscard]] inline double blind_wedge_rad(double wavelength_m, double speed_mps, double interval_s,
                                            double beam_width_rad) {
  return std::asin(std::fmin(1.0, wavelength_m / (2.0 * speed_mps * interval_s * beam_width_rad)));
}

/// How far along the flight direction a broadside mover appears from where it is: −r ṙ/V, ṙ its own part of the range
/// rate; forward when it approaches.                                          docs/physics/doppler.md, Eq. (6)
[[nodiscard]] inline double mover_shift_m(double range_m, double own_range_rate_mps, double platform_speed_mps) {
  return -range_m * own_range_rate_mps / platform_speed_mps;
}

}  // namespace sigmascape::radar
