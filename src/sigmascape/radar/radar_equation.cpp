#include "sigmascape/radar/radar_equation.h"

#include <cmath>

#include "sigmascape/base/units.h"
#include "sigmascape/radar/noise.h"
#include "sigmascape/radar/range_response.h"

namespace sigmascape::radar {

double received_power_w(const Radar& radar, double rcs_m2, double slant_range_m) {
  const double gain_wavelength = radar.antenna.gain * wavelength_m(radar.frequency_hz);
  const double r2 = slant_range_m * slant_range_m;
  return radar.waveform.peak_power_w * gain_wavelength * gain_wavelength * rcs_m2 *
         std::exp(-2.0 * radar.atmosphere_per_m * slant_range_m) /
         (std::pow(4.0 * pi, 3.0) * r2 * r2 * radar.receiver.losses);
}

double compression_gain(const Radar& radar) {
  const double bandwidth_hz = bandwidth_of(radar.range_resolution_m, radar.waveform.window);
  return bandwidth_hz * radar.waveform.pulse_length_s / WindowResponse(radar.waveform.window).noise_bandwidth();
}

double received_voltage_v(const Radar& radar, double rcs_m2, double slant_range_m) {
  const double power_w = received_power_w(radar, rcs_m2, slant_range_m) * compression_gain(radar) * radar.receiver.gain;
  return std::sqrt(power_w * radar.receiver.impedance_ohm);
}

double signal_to_noise(const Radar& radar, double rcs_m2, double slant_range_m) {
  return received_power_w(radar, rcs_m2, slant_range_m) * compression_gain(radar) / noise_power_w(radar);
}

}  // namespace sigmascape::radar
