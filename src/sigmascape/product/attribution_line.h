#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "sigmascape/product/picture.h"

namespace sigmascape::product {

/// The picture with what its metadata calls "attribution" written below it in small letters, on as many lines as that
/// takes. The ground keeps its pixels and its place; a picture too narrow for a few letters gets columns on its right.
/// Without an attribution it comes back as it is.
[[nodiscard]] Picture with_attribution(const Picture& picture);

/// The words of UTF-8 text on lines of at most so many letters, in order; a longer word is broken. Assumes
/// `most_letters` ≥ 1.
[[nodiscard]] std::vector<std::string> broken_into_lines(std::string_view text, std::size_t most_letters);

}  // namespace sigmascape::product
