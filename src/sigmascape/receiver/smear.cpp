#include "sigmascape/receiver/smear.h"

#include <cmath>

#include "sigmascape/base/units.h"
#include "sigmascape/receiver/fourier.h"

namespace sigmascape::receiver {
namespace {

/// A left-over phase of less than this at the ends of the interval, in radians, is focus.
constexpr double in_focus_rad = 0.05;
/// Cells beyond those that the Doppler wanders through, for the tails.
constexpr double tail_cells = 12.0;

/// The Doppler that a smeared point wanders through, in cells.
double wander_cells(double doppler_rate_error_hz_per_s, double interval_s) {
  return std::abs(doppler_rate_error_hz_per_s) * interval_s * interval_s;
}

}  // namespace

std::vector<SmearedPart> smeared(double doppler_rate_error_hz_per_s, double interval_s) {
  const double wander = wander_cells(doppler_rate_error_hz_per_s, interval_s);
  if (pi * wander / 4.0 < in_focus_rad) return {{0.0, {1.0F, 0.0F}}};
  const auto reach = static_cast<std::ptrdiff_t>(std::ceil(wander / 2.0) + tail_cells);
  // Twice as often as the fastest part asks for: what is faster and folds is weak.
  const std::size_t samples = fast_length(4 * static_cast<std::size_t>(reach));
  const auto count = static_cast<double>(samples);
  std::vector<std::complex<float>> left_over(samples), series(samples);
  for (std::size_t n = 0; n < samples; ++n) {
    const double t = (static_cast<double>(n) + 0.5) / count - 0.5;
    const double turns = 0.5 * std::copysign(wander, doppler_rate_error_hz_per_s) * t * t;
    left_over[n] = std::complex<float>(std::polar(1.0 / count, 2.0 * pi * std::remainder(turns, 1.0)));
  }
  Fourier(samples, Fourier::Direction::Forward).transform(left_over, series);
  std::vector<SmearedPart> parts;
  double power = 0.0;
  for (std::ptrdiff_t m = -reach; m <= reach; ++m) {
    const std::complex<float> part = series[static_cast<std::size_t>(m < 0 ? m + std::ssize(series) : m)];
    // From the first sample's time to that of the middle.
    const double turns = static_cast<double>(m) * 0.5 * (1.0 - 1.0 / count);
    parts.push_back(
        {static_cast<double>(m), part * std::complex<float>(std::polar(1.0, 2.0 * pi * std::remainder(turns, 1.0)))});
    power += static_cast<double>(std::norm(part));
  }
  const auto scale = static_cast<float>(1.0 / std::sqrt(power));
  for (SmearedPart& part : parts) part.amplitude *= scale;
  return parts;
}

std::vector<SmearedPart> smeared(const radar::Target& target, double doppler_rate_error_hz_per_s, const Dwell& dwell) {
  const auto voltage = [&](std::size_t pulse) {
    return static_cast<float>(std::sqrt(radar::fluctuation(target.fluctuation, target.seed, dwell.number, pulse)));
  };
  // What wanders through more cells than there are pulses folds, as all that lies on their Doppler axis does.
  const bool folds = wander_cells(doppler_rate_error_hz_per_s, dwell.interval_s) > static_cast<double>(dwell.pulses);
  const bool by_pulse = radar::changes_by_pulse(target.fluctuation);
  if (!by_pulse && !folds) {
    std::vector<SmearedPart> parts = smeared(doppler_rate_error_hz_per_s, dwell.interval_s);
    for (SmearedPart& part : parts) part.amplitude *= voltage(0);
    return parts;
  }
  const auto count = static_cast<double>(dwell.pulses), before_middle = static_cast<double>(dwell.pulses / 2);
  const double chirp = pi * doppler_rate_error_hz_per_s * dwell.interval_s * dwell.interval_s;
  std::vector<std::complex<float>> pulses(dwell.pulses), series(dwell.pulses);
  for (std::size_t n = 0; n < dwell.pulses; ++n) {
    const double t = (static_cast<double>(n) - before_middle) / count;
    pulses[n] = voltage(by_pulse ? n : 0) * std::complex<float>(std::polar(1.0, chirp * t * t));
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
