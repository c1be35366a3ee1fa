#pragma once

#include <algorithm>
#include <cmath>

#include "sigmascape/radar/receiver.h"

namespace sigmascape::radar {

/// The height of a step: full scale over half the number of codes.
[[nodiscard]] inline double step_v(const AnalogToDigital& converter) {
  return std::ldexp(converter.full_scale_v, 1 - converter.bits);
}

/// The code of a voltage, −2^(bits−1) to 2^(bits−1) − 1; what lies beyond full scale saturates.
[[nodiscard]] inline double code(const AnalogToDigital& converter, double volts) {
  const double half_range = std::ldexp(1.0, converter.bits - 1);
  return std::clamp(std::nearbyint(volts / step_v(converter)), -half_range, half_range - 1.0);
}

/// The voltage that the code stands for.
[[nodiscard]] inline double digitised_v(const AnalogToDigital& converter, double volts) {
  return code(converter, volts) * step_v(converter);
}

}  // namespace sigmascape::radar
