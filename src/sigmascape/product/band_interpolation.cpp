#include "sigmascape/product/band_interpolation.h"

#include <algorithm>
#include <cmath>

#include "sigmascape/base/units.h"

namespace sigmascape::product {
namespace {

constexpr std::size_t steps = 1024;  // of a sample: half of one is −56 dB of a turn at the band's edge
constexpr double kaiser_shape = 5.0;

double sinc(double x) {
  return x == 0.0 ? 1.0 : std::sin(pi * x) / (pi * x);
}

double kaiser(double x) {
  return std::cyl_bessel_i(0.0, kaiser_shape * std::sqrt(std::max(0.0, 1.0 - x * x)));
}

}  // namespace

BandInterpolation::BandInterpolation() : table_(steps + 1) {
  constexpr double half = static_cast<double>(taps) / 2.0;
  for (std::size_t step = 0; step <= steps; ++step) {
    std::array<double, taps> exact{};
    double sum = 0.0;
    for (std::size_t tap = 0; tap < taps; ++tap) {
      const double away = static_cast<double>(tap) - (half - 1.0) - static_cast<double>(step) / steps;
      exact[tap] = sinc(away) * kaiser(away / half);
      sum += exact[tap];
    }
    for (std::size_t tap = 0; tap < taps; ++tap) table_[step][tap] = static_cast<float>(exact[tap] / sum);
  }
}

const std::array<float, BandInterpolation::taps>& BandInterpolation::weights(double part) const {
  return table_[static_cast<std::size_t>(std::lround(part * steps))];
}

}  // namespace sigmascape::product
