#include "sigmascape/receiver/spreading_kernel.h"

#include <algorithm>
#include <cmath>

#include "sigmascape/base/units.h"

namespace sigmascape::receiver {
namespace {

constexpr std::size_t steps = 1024;
/// π √(W²/4 · (2 − ½)² − 0.8) for a width W of six samples and twofold oversampling [Beatty et al. 2005, Eq. (5)].
constexpr double shape = 13.8551;

/// The modified Bessel function I₀, by its power series.
double bessel_i0(double x) {
  double sum = 1.0, term = 1.0;
  for (int k = 1; term > 1e-16 * sum; ++k) {
    term *= (x / (2.0 * k)) * (x / (2.0 * k));
    sum += term;
  }
  return sum;
}

double pulse(double offset) {
  const double z = offset / static_cast<double>(SpreadingKernel::reach);
  return std::abs(z) > 1.0 ? 0.0 : bessel_i0(shape * std::sqrt(1.0 - z * z));
}

}  // namespace

SpreadingKernel::SpreadingKernel() : table_(steps + 1) {
  for (std::size_t step = 0; step <= steps; ++step) {
    for (std::size_t tap = 0; tap < taps; ++tap) {
      table_[step][tap] = static_cast<float>(
          pulse(static_cast<double>(tap) - static_cast<double>(reach) + static_cast<double>(step) / steps));
    }
  }
}

std::ptrdiff_t SpreadingKernel::first_tap(double x) {
  return static_cast<std::ptrdiff_t>(std::ceil(x)) - reach;
}

std::array<float, SpreadingKernel::taps> SpreadingKernel::weights(double x) const {
  const double place = (std::ceil(x) - x) * static_cast<double>(steps);
  const auto step = static_cast<std::size_t>(place);
  const auto part = static_cast<float>(place - static_cast<double>(step));
  const std::array<float, taps>&lower = table_[step], &upper = table_[std::min(step + 1, steps)];
  std::array<float, taps> weights;
  for (std::size_t tap = 0; tap < taps; ++tap) weights[tap] = lower[tap] + part * (upper[tap] - lower[tap]);
  return weights;
}

double SpreadingKernel::spectrum(double cycles_per_sample) {
  const double x = 2.0 * pi * static_cast<double>(reach) * cycles_per_sample;
  const double root = std::sqrt(shape * shape - x * x);
  return 2.0 * static_cast<double>(reach) * std::sinh(root) / root;
}

}  // namespace sigmascape::receiver
