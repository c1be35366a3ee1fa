#pragma once

#include <algorithm>
#include <cmath>

#include "sigmascape/radar/receiver.h"

namespace sigmascape::radar {

/// The power gain of the control at a range. docs/physics/radar_equation.md, Eq. (5).
[[nodiscard]] inline double power_gain(const SensitivityTimeControl& control, double range_m) {
  return std::min(1.0, std::pow(std::max(0.0, range_m) / control.full_gain_range_m, control.exponent));
}

}  // namespace sigmascape::radar
