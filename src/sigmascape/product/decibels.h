#pragma once

#include <algorithm>
#include <cmath>

#include "sigmascape/product/map_file.h"

namespace sigmascape::product {

/// 10 lg of a power, no less than `darkest_db`; NaN stays NaN.
[[nodiscard]] inline float decibels_of(float power) {
  if (std::isnan(power)) return power;
  constexpr auto least = static_cast<float>(darkest_db);
  return power > 0.0F ? std::max(least, 10.0F * std::log10(power)) : least;
}

}  // namespace sigmascape::product
