#pragma once

#include <string>

namespace sigmascape::product {

/// "0.1.0".
[[nodiscard]] std::string software_version();
/// What products name as their maker: "Sigmascape 0.1.0".
[[nodiscard]] std::string software_name();

}  // namespace sigmascape::product
