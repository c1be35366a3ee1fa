#pragma once

#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>

namespace sigmascape::cli {

/// With all digits; null for what is not finite, for which JSON has no number.
[[nodiscard]] inline nlohmann::ordered_json number_or_null(double number) {
  return std::isfinite(number) ? nlohmann::ordered_json(number) : nlohmann::ordered_json();
}

/// What is not known is null as well.
[[nodiscard]] inline nlohmann::ordered_json number_or_null(std::optional<double> number) {
  return number ? number_or_null(*number) : nlohmann::ordered_json();
}

}  // namespace sigmascape::cli
