#include "sigmascape/radar/noise.h"

#include "sigmascape/radar/range_response.h"

namespace sigmascape::radar {

double thermal_noise_w(double bandwidth_hz, double noise_factor) {
  return boltzmann_j_per_k * reference_temperature_k * bandwidth_hz * noise_factor;
}

double noise_power_w(const Radar& radar) {
  return thermal_noise_w(bandwidth_of(radar.range_resolution_m, radar.waveform.window), radar.receiver.noise_figure);
}

}  // namespace sigmascape::radar
