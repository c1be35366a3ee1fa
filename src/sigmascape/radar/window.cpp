#include "sigmascape/radar/window.h"

#include <cmath>

#include "sigmascape/base/units.h"

namespace sigmascape::radar {
namespace {

/// docs/physics/waveform.md, Eq. (2).
std::vector<CosineTerm> taylor_terms(double side_lobe, int terms) {
  const double a = std::acosh(1.0 / std::sqrt(side_lobe)) / pi;
  const double a2 = a * a;
  const double sigma2 = terms * terms / (a2 + (terms - 0.5) * (terms - 0.5));
  std::vector<CosineTerm> series{{0.0, 1.0}};
  for (int m = 1; m < terms; ++m) {
    const double m2 = m * m;
    double above = m % 2 == 1 ? 1.0 : -1.0, below = 1.0;
    for (int i = 1; i < terms; ++i) {
      above *= 1.0 - m2 / (sigma2 * (a2 + (i - 0.5) * (i - 0.5)));
      if (i != m) below *= 1.0 - m2 / (i * i);
    }
    series.push_back({static_cast<double>(m), above / below});
  }
  return series;
}

}  // namespace

std::vector<CosineTerm> cosine_terms(const Window& window) {
  switch (window.shape) {
    case WindowShape::Rectangular:
      return {{0.0, 1.0}};
    case WindowShape::Cosine:
      return {{0.5, pi / 2.0}};
    case WindowShape::Hamming:
      return {{0.0, 1.0}, {1.0, 0.46 / 0.54}};
    case WindowShape::Taylor:
      return taylor_terms(window.taylor_side_lobe, window.taylor_terms);
  }
  return {};
}

std::vector<double> window_weights(const Window& window, std::size_t count) {
  const auto terms = cosine_terms(window);
  std::vector<double> weights(count, 0.0);
  for (std::size_t k = 0; k < count; ++k) {
    const double x = (static_cast<double>(k) + 0.5) / static_cast<double>(count) - 0.5;
    for (const CosineTerm& term : terms) weights[k] += term.amplitude * std::cos(2.0 * pi * term.cycles * x);
  }
  return weights;
}

double noise_bandwidth(const Window& window, std::size_t count) {
  double sum = 0.0, squares = 0.0;
  for (const double weight : window_weights(window, count)) {
    sum += weight;
    squares += weight * weight;
  }
  return static_cast<double>(count) * squares / (sum * sum);
}

}  // namespace sigmascape::radar
