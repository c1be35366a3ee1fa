#pragma once

#include <algorithm>
#include <string>

namespace sigmascape {

/// A text with the letters A to Z made small, whatever the locale.
[[nodiscard]] inline std::string in_small_letters(std::string text) {
  std::ranges::transform(text, text.begin(),
                         [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
  return text;
}

}  // namespace sigmascape
