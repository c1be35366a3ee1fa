#pragma once

#include <cstddef>

#include "sigmascape/product/colour_scale.h"

namespace sigmascape::product {

/// How strips below a picture look.
inline constexpr Rgba legend_background{18, 18, 18, 255};
inline constexpr Rgba legend_ink{225, 225, 225, 255};

/// Pixels along a dot of the font below a picture of that width.
inline constexpr std::size_t legend_dot(std::size_t columns) {
  return columns < 900 ? 1 : columns / 450;
}

}  // namespace sigmascape::product
