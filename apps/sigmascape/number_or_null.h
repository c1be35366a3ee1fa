#pragma once

#include <nlohmann/json.hpp>
#include <optional>

namespace sigmascape::cli {

/// What is not known is null in JSON.
[[nodiscard]] inline nlohmann::ordered_json number_or_null(std::optional<double> number) {
  return number ? nlohmann::ordered_json(*number) : nlohmann::ordered_json(nullptr);
}

}  // namespace sigmascape::cli
