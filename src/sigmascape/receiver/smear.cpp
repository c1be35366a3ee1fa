#include "sigmascape/receiver/smear.h"

#include <algorithm>
#include <cmath>

#include "sigmascape/base/units.h"
#include "sigmascape/receiver/fourier.h"

namespace sigmascape::receiver {
namespace {

/// A left-over phase of less than this at the ends of the interval, in radians, is focus.
constexpr double in_focus_rad = 0.05;
/// Cells beyond those that the Doppler wanders through, for the tails.
constexpr int tail_cells = 12;
constexpr int most_cells = 4096;

}  // namespace

std::vector<SmearedPart> smeared(double doppler_rate_error_hz_per_s, double interval_s) {
  const double wander_cells = std::abs(doppler_rate_error_hz_per_s) * interval_s * interval_s;
  if (pi * wander_cells / 4.0 < in_focus_rad) return {{0.0, {1.0F, 0.0F}}};
  const int reach = static_cast<int>(std::min<double>(std::ceil(wander_cells / 2.0) + tail_cells, most_cells));
  const int samples = 4 * reach;
  std::vector<SmearedPart> parts;
  double power = 0.0;
  for (int m = -reach; m <= reach; ++m) {
    std::complex<double> sum;
    for (int n = 0; n < samples; ++n) {
      const double t = (n + 0.5) / samples - 0.5;
      sum += std::polar(1.0, pi * std::copysign(wander_cells, doppler_rate_error_hz_per_s) * t * t - 2.0 * pi * m * t);
    }
    sum /= samples;
    power += std::norm(sum);
    parts.push_back({static_cast<double>(m), std::complex<float>(sum)});
  }
  const auto scale = static_cast<float>(1.0 / std::sqrt(power));
  for (SmearedPart& part : parts) part.amplitude *= scale;
  return parts;
}

std::vector<SmearedPart> smeared(const radar::Target& target, double doppler_rate_error_hz_per_s, const Dwell& dwell) {
  const auto voltage = [&](std::size_t pulse) {
    return static_cast<float>(std::sqrt(radar::fluctuation(target.fluctuation, target.seed, dwell.number, pulse)));
  };
  if (!radar::changes_by_pulse(target.fluctuation)) {
    std::vector<SmearedPart> parts = smeared(doppler_rate_error_hz_per_s, dwell.interval_s);
    for (SmearedPart& part : parts) part.amplitude *= voltage(0);
    return parts;
  }
  const auto count = static_cast<double>(dwell.pulses), before_middle = static_cast<double>(dwell.pulses / 2);
  const double chirp = pi * doppler_rate_error_hz_per_s * dwell.interval_s * dwell.interval_s;
  std::vector<std::complex<float>> pulses(dwell.pulses), series(dwell.pulses);
  for (std::size_t n = 0; n < dwell.pulses; ++n) {
    const double t = (static_cast<double>(n) - before_middle) / count;
    pulses[n] = voltage(n) * std::complex<float>(std::polar(1.0, chirp * t * t));
  }
  Fourier(dwell.pulses, Fourier::Direction::Forward).transform(pulses, series);
  std::vector<SmearedPart> parts;
  const auto half = static_cast<std::ptrdiff_t>(dwell.pulses / 2);
  for (std::size_t k = 0; k < dwell.pulses; ++k) {
    // From the first pulse's time to that of the middle.
    const auto m = static_cast<double>((static_cast<std::ptrdiff_t>(k) + half) % std::ssize(series) - half);
    parts.push_back(
        {m, series[k] * std::complex<float>(std::polar(1.0 / count, 2.0 * pi * m * before_middle / count))});
  }
  return parts;
}

}  // namespace sigmascape::receiver
