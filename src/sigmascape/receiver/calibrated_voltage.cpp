#include "sigmascape/receiver/calibrated_voltage.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <utility>
#include <vector>

#include "sigmascape/base/error.h"
#include "sigmascape/base/hash.h"
#include "sigmascape/base/parallel.h"
#include "sigmascape/base/units.h"
#include "sigmascape/radar/complex_gaussian.h"
#include "sigmascape/radar/noise.h"
#include "sigmascape/radar/radar_equation.h"
#include "sigmascape/radar/range_ambiguity.h"
#include "sigmascape/receiver/fourier.h"

namespace sigmascape::receiver {
namespace {

/// Samples of noise that lie so many resolution cells apart have nothing in common, whatever the window.
constexpr double cells_apart = 8.0;

/// One draw a pulse, polarization and frequency.
std::complex<float> gaussian(std::uint64_t key, std::size_t frequency) {
  const std::uint64_t words = hashed(key, frequency);
  const radar::ComplexPair pair =
      radar::complex_gaussian({static_cast<std::uint32_t>(words), static_cast<std::uint32_t>(words >> 32U)});
  return {pair.re, pair.im};
}

}  // namespace

BeamAzimuth towards(Vec3d point) {
  return [point](const radar::Pulse& pulse) {
    const Vec3d away = point - pulse.platform.position;
    return azimuth_of(away);
  };
}

BeamAzimuth fixed_at(double azimuth_rad) {
  return [azimuth_rad](const radar::Pulse&) { return azimuth_rad; };
}

BeamAzimuth abeam(double clockwise_rad) {
  return [clockwise_rad](const radar::Pulse& pulse) { return azimuth_of(pulse.platform.velocity_mps) + clockwise_rad; };
}

VoltageGain calibrated_voltage(const radar::Radar& radar, BeamAzimuth beam) {
  const double atmosphere_per_m = radar.atmosphere_per_m;
  const double volts_in_vacuum_at_1_m = radar::received_voltage_v(radar, 1.0, 1.0) * std::exp(atmosphere_per_m);
  return [volts_in_vacuum_at_1_m, atmosphere_per_m, waveform = radar.waveform, pattern = radar::antenna_pattern(radar),
          beam = std::move(beam)](const radar::Pulse& pulse, Vec3d position, double range_m) {
    const Vec3d away = position - pulse.platform.position;
    const double offset = std::remainder(azimuth_of(away) - beam(pulse), 2.0 * pi);
    const double elevation = std::asin(away.z / length(away));
    // One way in voltage, squared for both ways; the peak is in the radar equation already.
    const double one_way = pattern.voltage(offset, elevation);
    const double heard = radar::uneclipsed_part(range_m, waveform.pulse_length_s, waveform.pulse_repetition_hz);
    return static_cast<float>(volts_in_vacuum_at_1_m * heard * one_way * one_way *
                              std::exp(-atmosphere_per_m * range_m) / (pattern.peak_gain() * range_m * range_m));
  };
}

void add_thermal_noise(radar::PhaseHistory& history, const radar::Radar& radar, std::uint64_t seed, unsigned threads) {
  if (history.unit != "V") {
    throw Error("thermal noise", "the record is in " + history.unit, "make it in volts, with calibrated_voltage");
  }
  // Frequencies that fill a period, of which the band has its part. The period is so much longer than the gate that its
  // ends, which meet, have nothing in common.
  const double step_m = history.range_step_m;
  const double apart_m = cells_apart * speed_of_light_mps / (2.0 * history.bandwidth_hz);
  const std::size_t samples =
      fast_length(history.samples.columns() + static_cast<std::size_t>(std::ceil(apart_m / step_m)));
  const double band = static_cast<double>(samples) * step_m * 2.0 * history.bandwidth_hz / speed_of_light_mps;
  const auto kept = std::min(samples, static_cast<std::size_t>(std::llround(band)));
  const std::vector<double> window = radar::window_weights(radar.waveform.window, kept);
  double window_power = 0.0;
  for (const double w : window) window_power += w * w;
  const double variance = radar::noise_power_w(radar) * radar.receiver.gain * radar.receiver.impedance_ohm;
  const double scale = std::sqrt(variance / window_power);

  const Fourier backward(samples, Fourier::Direction::Backward);
  parallel_for(history.samples.rows(), threads, [&](std::size_t pulse, unsigned) {
    std::vector<std::complex<float>> spectrum(samples), noise(samples);
    for (std::size_t p = 0; p < radar::ComplexChannels::count; ++p) {
      std::fill(spectrum.begin(), spectrum.end(), std::complex<float>{});
      for (std::size_t k = 0; k < kept; ++k) {
        const std::size_t frequency = (k + samples - kept / 2) % samples;
        spectrum[frequency] = gaussian(hashed(seed, pulse, p), k) * static_cast<float>(scale * window[k]);
      }
      backward.transform(spectrum, noise);
      for (std::size_t m = 0; m < history.samples.columns(); ++m) {
        radar::ComplexChannels& sample = history.samples(m, pulse);
        (p == 0 ? sample.vv : p == 1 ? sample.hh : sample.hv) += noise[m];
      }
    }
  });
}

}  // namespace sigmascape::receiver
