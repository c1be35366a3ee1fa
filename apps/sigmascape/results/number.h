#pragma once

#include <cmath>
#include <nlohmann/json.hpp>

namespace sigmascape::cli {

/// With all digits; null for what is not finite, for which JSON has no number.
[[nodiscard]] inline nlohmann::ordered_json number(double value) {
  return std::isfinite(value) ? nlohmann::ordered_json(value) : nlohmann::ordered_json();
}

}  // namespace sigmascape::cli
