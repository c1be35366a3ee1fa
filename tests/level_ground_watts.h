#pragma once

#include <cmath>
#include <numbers>

#include "sigmascape/base/units.h"
#include "sigmascape/radar/radar.h"

namespace sigmascape {

/// What level ground of that σ0 returns from a range, compressed, over a flat Earth and before the receiver's gain:
///
///     P = P_t G² λ² σ0 A C / ((4π)³ r⁴ L),   A C = r · θ √(π / (8 ln 2)) · c τ / 2
///
/// The area A is the beam's two-way angle, θ its one-way width, times the compressed pulse's length; the latter falls
/// as the gain of compression C rises, whatever the bandwidth and the window.
inline double level_ground_w(const radar::Radar& radar, double range_m, double sigma0) {
  const double lambda_m = wavelength_m(radar.frequency_hz);
  const double beam_rad = radar.beam_width_rad * std::sqrt(pi / (8.0 * std::numbers::ln2));
  const double gained_area_m2 = range_m * beam_rad * speed_of_light_mps * radar.waveform.pulse_length_s / 2.0;
  return radar.waveform.peak_power_w * std::pow(radar.antenna.gain * lambda_m, 2.0) * sigma0 * gained_area_m2 /
         (std::pow(4.0 * pi, 3.0) * std::pow(range_m, 4.0) * radar.receiver.losses);
}

}  // namespace sigmascape
