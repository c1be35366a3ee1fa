#pragma once

#include <algorithm>
#include <cmath>

#include "sigmascape/product/map_file.h"

namespace sigmascape::product {

/// 10 lg of a power, no less than `least_db`; NaN stays NaN.
[[nodiscard]] inline float decibels_of(float power, double least_db = darkest_db) {
  if (std::isnan(power)) return power;
  const auto least = static_cast<float>(least_db);
  return power > 0.0F ? std::max(least, 10.0F * std::log10(power)) : least;
}

}  // namespace sigmascape::product
