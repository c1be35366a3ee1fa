#include "noise.h"

#include <algorithm>
#include <cmath>

namespace sigmascape::bench {

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
  if (relative.empty()) return noise;
  const auto middle = relative.begin() + static_cast<std::ptrdiff_t>(relative.size() / 2);
  std::ranges::nth_element(relative, middle);
  noise.median_relative = *middle;
  return noise;
}

}  // namespace sigmascape::bench
