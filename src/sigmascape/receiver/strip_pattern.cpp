#include "sigmascape/receiver/strip_pattern.h"

#include <algorithm>
#include <cmath>

namespace sigmascape::receiver {
namespace {

/// On the ground, from broadside on.
double azimuth_of(double sine, double cosine_depression) {
  return std::atan2(sine, std::sqrt(1.0 - sine * sine) * cosine_depression);
}

}  // namespace

StripPattern::StripPattern(const radar::AntennaCut& azimuth, double squint_rad, bool looks_left)
    : azimuth_(azimuth), sine_squint_(std::sin(squint_rad)), clockwise_(looks_left ? 1.0 : -1.0) {}

double StripPattern::voltage(double sine_seen, double sine_believed, double sine_depression) const {
  if (!(std::abs(sine_seen) < 1.0 && std::abs(sine_believed) < 1.0)) return 0.0;
  const double cosine = std::sqrt(std::max(1.0 - sine_depression * sine_depression, 0.0));
  const double axis = azimuth_of(sine_squint_, cosine);
  // One-way power is two-way voltage.
  const double there = azimuth_.power(clockwise_ * (azimuth_of(sine_seen, cosine) - axis)),
               here = azimuth_.power(clockwise_ * (azimuth_of(sine_believed, cosine) - axis));
  return here > 0.0 ? there / here : 0.0;
}

}  // namespace sigmascape::receiver
