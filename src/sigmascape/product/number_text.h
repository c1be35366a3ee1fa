#pragma once

#include <string>

namespace sigmascape::product {

/// "0.83"; `none` for what is not a number. What rounds to nothing has no sign.
[[nodiscard]] std::string number_text(double value, int decimals, const char* none);
/// The same with its sign: "+0.83".
[[nodiscard]] std::string signed_text(double value, int decimals, const char* none);

}  // namespace sigmascape::product
