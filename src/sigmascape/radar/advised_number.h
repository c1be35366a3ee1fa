#pragma once

#include <cmath>

namespace sigmascape::radar {

/// A positive number in so many digits, and no less than it is: what a message advises is then not refused.
[[nodiscard]] inline double rounded_up(double value, int digits) {
  const double step = std::pow(10.0, std::floor(std::log10(value)) - (digits - 1));
  return std::ceil(value / step) * step;
}
/// The same, and no more than it is.
[[nodiscard]] inline double rounded_down(double value, int digits) {
  const double step = std::pow(10.0, std::floor(std::log10(value)) - (digits - 1));
  return std::floor(value / step) * step;
}

}  // namespace sigmascape::radar
