#include "results/draped_view.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "sigmascape/base/units.h"
#include "sigmascape/base/vec.h"
#include "sigmascape/radar/look.h"

namespace sigmascape::cli {
namespace {

constexpr double squares_a_side = 8.0;  // of two triangles each
constexpr double edge_width_pixels = 1.0;
constexpr product::Rgba nothing{18, 18, 18}, edge_ink{20, 20, 60};

product::Rgba mean(const auto& colours) {
  unsigned red = 0, green = 0, blue = 0;
  for (const product::Rgba& colour : colours) {
    red += colour.red;
    green += colour.green;
    blue += colour.blue;
  }
  const auto part = [&](unsigned sum) { return static_cast<std::uint8_t>(sum / std::size(colours)); };
  return {part(red), part(green), part(blue)};
}

/// How far a number is from the nearest whole one.
double from_whole(double value) {
  return std::abs(value - std::round(value));
}

/// Whether an edge of a triangle runs within so many squares of the point, given in squares.
bool is_on_edge(Vec2d square, double within) {
  return std::min({from_whole(square.x), from_whole(square.y), from_whole(square.x + square.y) / std::sqrt(2.0)}) <
         within;
}

/// The ground as an orthographic view shows it.
class ObliqueView {
 public:
  ObliqueView(const product::Picture& texture, std::size_t pixels_wide) : texture_(texture) {
    const double side_m = texture.grid.extent().width_m();
    // A square that is turned is as wide and as deep as its corners reach.
    pixel_m_ = side_m * (std::abs(right_.x) + std::abs(right_.y)) / static_cast<double>(pixels_wide);
    columns_ = static_cast<double>(pixels_wide);
    rows_ = std::ceil(columns_ * std::sin(elevation_rad));
    square_m_ = side_m / squares_a_side;
  }

  [[nodiscard]] std::size_t rows() const { return static_cast<std::size_t>(rows_); }

  /// At a place of the view in pixels.
  [[nodiscard]] product::Rgba at(Vec2d pixel) const {
    const radar::GroundGrid& grid = texture_.grid;
    const double across_m = (pixel.x - columns_ / 2.0) * pixel_m_;
    const double nearer_m = (pixel.y - rows_ / 2.0) * pixel_m_ * columns_ / rows_;
    const Vec2d place = grid.extent().centre() + right_ * across_m + towards_ * nearer_m;
    if (!grid.extent().contains(place)) return nothing;
    const Vec2d cells = grid.cells_from(place);
    const product::Rgba colour = texture_.pixels(std::min(static_cast<std::size_t>(cells.x), grid.columns - 1),
                                                 std::min(static_cast<std::size_t>(cells.y), grid.rows - 1));
    const bool on_edge = is_on_edge(cells * (grid.cell_m / square_m_), 0.5 * edge_width_pixels * pixel_m_ / square_m_);
    return on_edge ? mean(std::array{colour, edge_ink}) : colour;
  }

 private:
  static constexpr double azimuth_rad = radians_from_deg(160.0), elevation_rad = radians_from_deg(38.0);

  const product::Picture& texture_;
  Vec2d towards_ = radar::horizontal_direction(azimuth_rad), right_{-towards_.y, towards_.x};
  double pixel_m_ = 1.0, square_m_ = 1.0;
  double columns_ = 0.0, rows_ = 0.0;
};

}  // namespace

product::Picture draped_view(const product::Picture& texture, std::size_t pixels_wide) {
  const ObliqueView ground(texture, pixels_wide);
  product::Picture view = texture;
  view.metadata.erase("crs");
  view.pixels = Array2D<product::Rgba>(pixels_wide, ground.rows());
  for (std::size_t row = 0; row < ground.rows(); ++row) {
    for (std::size_t column = 0; column < pixels_wide; ++column) {
      const Vec2d corner{static_cast<double>(column), static_cast<double>(row)};
      view.pixels(column, row) =
          mean(std::array{ground.at(corner + Vec2d{0.25, 0.25}), ground.at(corner + Vec2d{0.75, 0.25}),
                          ground.at(corner + Vec2d{0.25, 0.75}), ground.at(corner + Vec2d{0.75, 0.75})});
    }
  }
  return view;
}

}  // namespace sigmascape::cli
