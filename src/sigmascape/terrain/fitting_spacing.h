#pragma once

#include <cmath>

namespace sigmascape::terrain {

/// The spacing, rounded up to two digits, at which the same ground takes no more than `memory_bytes`, where heights
/// every `spacing_m` take `bytes`.
[[nodiscard]] inline double fitting_spacing_m(double spacing_m, double bytes, double memory_bytes) {
  const double fitting_m = spacing_m * std::sqrt(bytes / memory_bytes),
               second_digit_m = std::pow(10.0, std::floor(std::log10(fitting_m)) - 1.0);
  return std::ceil(fitting_m / second_digit_m) * second_digit_m;
}

}  // namespace sigmascape::terrain
