#pragma once

#include <algorithm>
#include <cstddef>

#include "sigmascape/base/array2d.h"
#include "sigmascape/product/colour_scale.h"

namespace sigmascape::product {

/// A rectangle of pixels by its upper left corner.
struct PixelRectangle {
  std::size_t column, row, width, height;
};

/// Fills the part of the rectangle that lies inside the pixels.
inline void fill_rectangle(Array2D<Rgba>& pixels, const PixelRectangle& area, Rgba ink) {
  const std::size_t last_row = std::min(area.row + area.height, pixels.rows());
  const std::size_t last_column = std::min(area.column + area.width, pixels.columns());
  for (std::size_t row = area.row; row < last_row; ++row) {
    for (std::size_t column = area.column; column < last_column; ++column) pixels(column, row) = ink;
  }
}

}  // namespace sigmascape::product
