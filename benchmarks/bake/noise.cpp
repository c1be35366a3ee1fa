#include "noise.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace sigmascape::bench {

double median_of(std::vector<double> values) {
  if (values.empty()) return 0.0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::ranges::nth_element(values, middle);
  return *middle;
}

std::vector<std::size_t> noisy_texels(const std::vector<float>& one, const std::vector<float>& other,
                                      const std::vector<float>& direct) {
  std::vector<std::size_t> texels;
  for (std::size_t i = 0; i < one.size(); ++i) {
    if (direct[i] > 0.0F && std::abs(one[i] - other[i]) > 1e-3F * 0.5F * (one[i] + other[i])) texels.push_back(i);
  }
  return texels;
}

Noise noise_of(const std::vector<float>& one, const std::vector<float>& other, const std::vector<std::size_t>& texels) {
  const auto deviation = [&](std::size_t i) {
    return std::abs(static_cast<double>(one[i]) - static_cast<double>(other[i])) / std::sqrt(2.0);
  };
  const auto mean = [&](std::size_t i) { return 0.5 * (static_cast<double>(one[i]) + static_cast<double>(other[i])); };
  Noise noise;
  double deviations = 0.0, means = 0.0;
  for (std::size_t i = 0; i < one.size(); ++i) {
    deviations += deviation(i);
    means += mean(i);
  }
  noise.l1 = deviations / means;
  std::vector<double> relative;
  for (const std::size_t i : texels) {
    if (mean(i) > 0.0) relative.push_back(deviation(i) / mean(i));
  }
  noise.median_relative = median_of(std::move(relative));
  return noise;
}

Total total_of(const std::vector<float>& one, const std::vector<float>& other) {
  Total total;
  double variance = 0.0;
  for (std::size_t i = 0; i < one.size(); ++i) {
    const double a = static_cast<double>(one[i]), b = static_cast<double>(other[i]);
    total.power += 0.5 * (a + b);
    variance += 0.25 * (a - b) * (a - b);
  }
  total.standard_error = std::sqrt(variance);
  return total;
}

Honesty honesty_of(const MapWithErrors& one, const MapWithErrors& other, const std::vector<std::size_t>& texels) {
  constexpr double interval = 1.979;
  double predicted = 0.0, actual = 0.0;
  std::size_t covered = 0, counted = 0;
  for (const std::size_t i : texels) {
    const double a = static_cast<double>(one.power[i]), b = static_cast<double>(other.power[i]), mean = 0.5 * (a + b);
    if (mean <= 0.0) continue;
    const double variance = std::pow(a * static_cast<double>(one.relative_errors[i]), 2.0) +
                            std::pow(b * static_cast<double>(other.relative_errors[i]), 2.0);
    const double square = (a - b) * (a - b);
    predicted += variance / (mean * mean);
    actual += square / (mean * mean);
    covered += square <= interval * interval * variance ? 1U : 0U;
    ++counted;
  }
  return {std::sqrt(predicted / actual), static_cast<double>(covered) / static_cast<double>(counted)};
}

}  // namespace sigmascape::bench
