#include "sigmascape/receiver/equivalent_noise.h"

#include <algorithm>
#include <cmath>

#include "sigmascape/base/hash.h"
#include "sigmascape/radar/noise.h"
#include "sigmascape/radar/radar_equation.h"
#include "sigmascape/radar/range_ambiguity.h"

namespace sigmascape::receiver {
namespace {

/// What brings less than this is not evened out: 60 dB.
constexpr double least_voltage = 1e-3;

}  // namespace

std::uint64_t noise_seed(std::uint64_t seed, std::uint64_t dwell) {
  constexpr std::uint64_t of_noise = 0x6e6f697365;  // no other draw is named so
  return hashed(seed, of_noise, dwell);
}

std::uint64_t noise_seed(std::uint64_t seed, std::uint64_t dwell, radar::Polarization polarization) {
  return hashed(noise_seed(seed, dwell), static_cast<std::uint64_t>(polarization));
}

double EquivalentNoise::rcs_m2(double range_m, double pulses, double noise_bandwidth) const {
  const radar::Waveform& sent = radar_.waveform;
  const double heard =
      std::max(radar::uneclipsed_part(range_m, sent.pulse_length_s, sent.pulse_repetition_hz), least_voltage);
  return noise_bandwidth / (radar::signal_to_noise(radar_, 1.0, range_m) * heard * heard * pulses);
}

double EquivalentNoise::lift(const radar::Pulse& pulse, Vec3d position) const {
  if (!divided_out_) return 1.0;
  const auto voltage = static_cast<double>(divided_out_(pulse, position, length(position - pulse.platform.position)));
  return 1.0 / std::pow(std::max(std::abs(voltage), least_voltage), 2.0);
}

}  // namespace sigmascape::receiver
