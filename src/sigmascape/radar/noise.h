#pragma once

#include "sigmascape/radar/radar.h"

namespace sigmascape::radar {

inline constexpr double boltzmann_j_per_k = 1.380649e-23;
/// The temperature that noise figures refer to.
inline constexpr double reference_temperature_k = 290.0;

/// Thermal noise of a receiver, referred to the antenna's terminals: k T₀ B F. docs/physics/radar_equation.md, Eq. (2).
[[nodiscard]] double thermal_noise_w(double bandwidth_hz, double noise_factor);
/// The same for this radar: B is the bandwidth that its range resolution and window need.
[[nodiscard]] double noise_power_w(const Radar& radar);

}  // namespace sigmascape::radar
