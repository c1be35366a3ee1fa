#include "sigmascape/product/contact_sheet.h"

#include <algorithm>
#include <cmath>

#include "sigmascape/base/error.h"

namespace sigmascape::product {
namespace {

constexpr std::size_t thumbnail_gap = 2;

}  // namespace

Array2D<std::uint8_t> thumbnail(const Picture& picture, std::size_t side) {
  Array2D<std::uint8_t> small(side, side);
  const std::size_t columns = picture.pixels.columns(), rows = picture.pixels.rows();
  for (std::size_t row = 0; row < side; ++row) {
    for (std::size_t column = 0; column < side; ++column) {
      const std::size_t left = column * columns / side, right = std::max(left + 1, (column + 1) * columns / side);
      const std::size_t top = row * rows / side, bottom = std::max(top + 1, (row + 1) * rows / side);
      std::size_t sum = 0;
      for (std::size_t y = top; y < bottom; ++y) {
        for (std::size_t x = left; x < right; ++x) sum += picture.pixels(x, y).green;
      }
      small(column, row) = static_cast<std::uint8_t>(sum / ((right - left) * (bottom - top)));
    }
  }
  return small;
}

Picture contact_sheet(std::span<const Array2D<std::uint8_t>> thumbnails) {
  if (thumbnails.empty()) throw Error("contact sheet", "has no pictures", "give one at least");
  const std::size_t side = thumbnails.front().columns(), pitch = side + thumbnail_gap;
  const auto across = static_cast<std::size_t>(std::ceil(std::sqrt(static_cast<double>(thumbnails.size()))));
  const std::size_t down = (thumbnails.size() + across - 1) / across;
  Picture sheet;
  sheet.pixels = Array2D<Rgba>(across * pitch + thumbnail_gap, down * pitch + thumbnail_gap, unseen_colour);
  sheet.grid = {0.0, 0.0, 1.0, sheet.pixels.columns(), sheet.pixels.rows()};
  for (std::size_t k = 0; k < thumbnails.size(); ++k) {
    const std::size_t left = thumbnail_gap + k % across * pitch, top = thumbnail_gap + k / across * pitch;
    for (std::size_t row = 0; row < side; ++row) {
      for (std::size_t column = 0; column < side; ++column) {
        const std::uint8_t grey = thumbnails[k](column, row);
        sheet.pixels(left + column, top + row) = {grey, grey, grey, 255};
      }
    }
  }
  return sheet;
}

}  // namespace sigmascape::product
