#pragma once

#include <cmath>
#include <numbers>

namespace sigmascape {

/// Inside the library angles are radians, frequencies hertz and powers linear. These functions stand at the doors,
/// where files, options and pictures speak degrees and decibels.

inline constexpr double pi = std::numbers::pi;
inline constexpr double speed_of_light_mps = 299'792'458.0;
/// Vacuum permittivity, CODATA 2018.
inline constexpr double vacuum_permittivity_f_per_m = 8.8541878128e-12;

[[nodiscard]] constexpr double radians_from_deg(double degrees) {
  return degrees * (pi / 180.0);
}
[[nodiscard]] constexpr double deg_from_radians(double radians) {
  return radians * (180.0 / pi);
}

[[nodiscard]] inline double linear_from_db(double decibels) {
  return std::pow(10.0, decibels / 10.0);
}
[[nodiscard]] inline double db_from_linear(double power) {
  return 10.0 * std::log10(power);
}

[[nodiscard]] constexpr double wavelength_m(double frequency_hz) {
  return speed_of_light_mps / frequency_hz;
}

/// The angle brought into [0, 2π).
[[nodiscard]] inline double wrapped_azimuth(double azimuth_rad) {
  const double turned = std::fmod(azimuth_rad, 2.0 * pi);
  const double positive = turned < 0.0 ? turned + 2.0 * pi : turned;
  // The least negative angles round to the full turn.
  return positive < 2.0 * pi ? positive : 0.0;
}

/// The angle brought to the same direction within half a turn of zero: std::remainder, quick where nothing is to be
/// done.
[[nodiscard]] inline double turned_by_least(double angle_rad) {
  return std::abs(angle_rad) <= pi ? angle_rad : std::remainder(angle_rad, 2.0 * pi);
}

}  // namespace sigmascape
