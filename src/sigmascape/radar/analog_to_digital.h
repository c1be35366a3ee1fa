#pragma once

#include <algorithm>
#include <cmath>

#include "sigmascape/radar/receiver.h"

namespace sigmascape::radar {

/// The height of a step: full scale over half the number of codes.
[[nodiscard]] inline double step_v(const AnalogToDigital& converter) {
  return std::ldexp(converter.full_scale_v, 1 - converter.bits);
}

/// A voltage in whole steps.
[[nodiscard]] inline double nearest_steps(const AnalogToDigital& converter, double volts) {
  return std::nearbyint(volts / step_v(converter));
}

/// The code of a voltage, −2^(bits−1) to 2^(bits−1) − 1; what lies beyond full scale saturates.
[[nodiscard]] inline double code(const AnalogToDigital& converter, double volts) {
  const double half_range = std::ldexp(1.0, converter.bits - 1);
  return std::clamp(nearest_steps(converter, volts), -half_range, half_range - 1.0);
}

/// Whether no code stands for a voltage, rounded to steps: one beyond full scale, or less than half a step below it on
/// the positive side, where there is a code less. What was never received, a NaN, does not.
[[nodiscard]] inline bool saturates(const AnalogToDigital& converter, double volts) {
  return !std::isnan(volts) && code(converter, volts) != nearest_steps(converter, volts);
}

/// The voltage that the code stands for.
[[nodiscard]] inline double digitised_v(const AnalogToDigital& converter, double volts) {
  return code(converter, volts) * step_v(converter);
}

}  // namespace sigmascape::radar
