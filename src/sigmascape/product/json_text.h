#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace sigmascape::product {

/// A document as the text of a file, a member a line. Names that were taken from files are bytes, which need not be
/// UTF-8 as JSON is: what of them is none becomes U+FFFD.
[[nodiscard]] inline std::string json_text(const nlohmann::ordered_json& json, int indent) {
  return json.dump(indent, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace sigmascape::product
