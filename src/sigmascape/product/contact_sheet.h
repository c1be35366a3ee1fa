#pragma once

#include <cstdint>
#include <span>

#include "sigmascape/base/array2d.h"
#include "sigmascape/product/picture.h"

namespace sigmascape::product {

/// A small grey copy of a picture, each of its pixels the mean of those that it covers: `side` × `side`.
[[nodiscard]] Array2D<std::uint8_t> thumbnail(const Picture& picture, std::size_t side);

/// Thumbnails of one size side by side, row after row, in a sheet about as wide as high. Throws Error when there are
/// none.
[[nodiscard]] Picture contact_sheet(std::span<const Array2D<std::uint8_t>> thumbnails);

}  // namespace sigmascape::product
