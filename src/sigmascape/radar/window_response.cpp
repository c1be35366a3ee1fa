#include "sigmascape/radar/window_response.h"

#include <algorithm>
#include <cmath>

#include "sigmascape/base/units.h"

namespace sigmascape::radar {
namespace {

double sinc(double t) {
  const double angle = pi * t;
  return std::abs(angle) < 1e-5 ? 1.0 - angle * angle / 6.0 : std::sin(angle) / angle;
}

/// Where a function that is positive at `low` and not at `high` changes sign.
template <typename F>
double sign_change(double low, double high, F&& f) {
  for (int i = 0; i < 80; ++i) {
    const double middle = 0.5 * (low + high);
    (f(middle) > 0.0 ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

}  // namespace

WindowResponse::WindowResponse(const Window& window) : terms_(cosine_terms(window)) {
  double beyond = 0.0;
  while (voltage(beyond) > 0.0) beyond += 0.05;
  first_null_ = sign_change(beyond - 0.05, beyond, [this](double t) { return voltage(t); });
  half_power_width_ = 2.0 * sign_change(0.0, first_null_, [this](double t) { return power(t) - 0.5; });
}

double WindowResponse::voltage(double t) const {
  double sum = 0.0;
  for (const CosineTerm& term : terms_) sum += 0.5 * term.amplitude * (sinc(t - term.cycles) + sinc(t + term.cycles));
  return sum;
}

double WindowResponse::peak_side_lobe() const {
  // Side lobes have the width one and beyond the last term of the series they only fall.
  const double end = first_null_ + terms_.back().cycles + 4.0;
  constexpr double step = 1e-3;
  double highest = 0.0;
  for (double t = first_null_; t < end; t += step) highest = std::max(highest, power(t));
  return highest;
}

double WindowResponse::integrated_side_lobes() const {
  constexpr int steps = 4000;
  double main_lobe = 0.5 * (power(0.0) + power(first_null_));
  for (int k = 1; k < steps; ++k) main_lobe += power(first_null_ * k / steps);
  main_lobe *= 2.0 * first_null_ / steps;
  return noise_bandwidth() / main_lobe - 1.0;
}

double WindowResponse::noise_bandwidth() const {
  // Parseval: the mean of w², of which cosines with whole cycles are orthogonal; a term alone needs no orthogonality.
  double mean_square = 0.0;
  for (const CosineTerm& term : terms_)
    mean_square += term.amplitude * term.amplitude * (term.cycles == 0.0 ? 1.0 : 0.5);
  return mean_square;
}

int taylor_terms_for(double side_lobe, int fewest) {
  // Where it is met it is met by some hundredths of a decibel.
  const double met = 1.001 * side_lobe;
  int terms = fewest;
  const auto peak = [&] {
    return WindowResponse({.shape = WindowShape::Taylor, .taylor_side_lobe = side_lobe, .taylor_terms = terms})
        .peak_side_lobe();
  };
  while (peak() > met) ++terms;
  return terms;
}

}  // namespace sigmascape::radar
