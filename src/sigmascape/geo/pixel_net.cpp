#include "sigmascape/geo/pixel_net.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace sigmascape::geo {
namespace {

bool is_finite(Vec2d position) {
  return std::isfinite(position.x) && std::isfinite(position.y);
}

/// Lengths of the sides of a mesh of the net.
std::array<double, 4> sides_of(const Array2D<Vec2d>& knots, std::size_t i, std::size_t j) {
  return {length(knots(i + 1, j) - knots(i, j)), length(knots(i + 1, j + 1) - knots(i, j + 1)),
          length(knots(i, j + 1) - knots(i, j)), length(knots(i + 1, j + 1) - knots(i + 1, j))};
}

}  // namespace

void PixelBox::take_in(Vec2d pixel) {
  if (!is_finite(pixel)) return;
  least = {std::min(least.x, pixel.x), std::min(least.y, pixel.y)};
  greatest = {std::max(greatest.x, pixel.x), std::max(greatest.y, pixel.y)};
}

PixelNet::PixelNet(const Lattice& lattice, const CoordinateTransform& transform, ToPixels to_pixels)
    : lattice_(lattice),
      transform_(transform),
      to_pixels_(std::move(to_pixels)),
      stride_(std::clamp<std::size_t>(static_cast<std::size_t>(100.0 / lattice.spacing_m), 1, 64)),
      knots_(lattice.columns / stride_ + 2, lattice.rows / stride_ + 2) {
  const double step_m = lattice.spacing_m * static_cast<double>(stride_);
  for (std::size_t row = 0; row < knots_.rows(); ++row) {
    for (std::size_t column = 0; column < knots_.columns(); ++column) {
      knots_(column, row) = {lattice.west_m + static_cast<double>(column) * step_m,
                             lattice.north_m - static_cast<double>(row) * step_m};
    }
  }
  transform_.to_crs(knots_.values());
  to_pixels_(knots_.values());
  find_torn_meshes();
}

PixelNet::Place PixelNet::place_of(double column, double row) const {
  const double across = column / static_cast<double>(stride_), down = row / static_cast<double>(stride_);
  const auto i = static_cast<std::size_t>(std::clamp(across, 0.0, static_cast<double>(knots_.columns() - 2)));
  const auto j = static_cast<std::size_t>(std::clamp(down, 0.0, static_cast<double>(knots_.rows() - 2)));
  return {i, j, across - static_cast<double>(i), down - static_cast<double>(j)};
}

Vec2d PixelNet::exact_at(double column, double row) const {
  Vec2d position = in_frame(column, row);
  transform_.to_crs({&position, 1});
  to_pixels_({&position, 1});
  return position;
}

/// Those of a side very much longer than others, if their exact middle lies elsewhere than that of their corners: a
/// map's far ends are a good part of the globe apart, and near a pole degrees of longitude alone are short.
void PixelNet::find_torn_meshes() {
  constexpr double much = 50.0, cells_astray = 1.0, sides_astray = 0.05;
  double shortest = std::numeric_limits<double>::infinity();
  for (std::size_t j = 0; j + 1 < knots_.rows(); ++j) {
    for (std::size_t i = 0; i + 1 < knots_.columns(); ++i) {
      for (const double side : sides_of(knots_, i, j)) shortest = side < shortest ? side : shortest;
    }
  }
  const double astray = std::max(cells_astray, sides_astray * shortest);
  for (std::size_t j = 0; j + 1 < knots_.rows(); ++j) {
    for (std::size_t i = 0; i + 1 < knots_.columns(); ++i) {
      const auto sides = sides_of(knots_, i, j);
      if (std::ranges::none_of(sides, [&](double side) { return side > much * shortest; })) continue;
      const auto half_way = [this](std::size_t knot) {
        return (static_cast<double>(knot) + 0.5) * static_cast<double>(stride_);
      };
      const Vec2d middle = exact_at(half_way(i), half_way(j)), linear = between_knots({i, j, 0.5, 0.5});
      if (!(length(middle - linear) > astray)) continue;
      if (torn_.empty()) torn_ = Array2D<std::uint8_t>(knots_.columns() - 1, knots_.rows() - 1, 0);
      torn_(i, j) = 1;
    }
  }
}

bool PixelNet::is_torn(const LatticeBlock& block) const {
  if (torn_.empty()) return false;
  const Place first = place_of(static_cast<double>(block.column) - 0.5, static_cast<double>(block.row) - 0.5),
              last = place_of(static_cast<double>(block.column + block.columns) - 0.5,
                              static_cast<double>(block.row + block.rows) - 0.5);
  for (std::size_t j = first.j; j <= last.j; ++j) {
    for (std::size_t i = first.i; i <= last.i; ++i) {
      if (is_torn(i, j)) return true;
    }
  }
  return false;
}

PixelBox PixelNet::box_of(const LatticeBlock& block) const {
  // Between neighbouring lines of knots no position lies beyond those at the corners.
  PixelBox box;
  bool has_gaps = false;
  for (const double row : lines_across(block.row, block.rows)) {
    for (const double column : lines_across(block.column, block.columns)) {
      const Vec2d pixel = at(column, row);
      has_gaps = has_gaps || !is_finite(pixel);
      box.take_in(pixel);
    }
  }
  if (!has_gaps) return box;
  // Beside a knot that has no position `at` tells nothing of the next one, to which positions on its other side
  // reach.
  for (std::size_t j = block.row / stride_; j <= (block.row + block.rows) / stride_; ++j) {
    for (std::size_t i = block.column / stride_; i <= (block.column + block.columns) / stride_; ++i)
      box.take_in(knots_(i, j));
  }
  return box;
}

/// The ends of a stretch of points, half a spacing beyond them, and the lines of knots between.
std::vector<double> PixelNet::lines_across(std::size_t first, std::size_t count) const {
  std::vector<double> lines{static_cast<double>(first) - 0.5};
  for (std::size_t knot = (first + stride_ - 1) / stride_ * stride_; knot < first + count; knot += stride_)
    lines.push_back(static_cast<double>(knot));
  lines.push_back(static_cast<double>(first + count) - 0.5);
  return lines;
}

}  // namespace sigmascape::geo
