#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "sigmascape/base/vec.h"
#include "sigmascape/radar/ground_grid.h"

namespace sigmascape::scene {

using Corners = std::array<Vec3d, 3>;

/// What a triangle lies over.
[[nodiscard]] inline radar::Rectangle plan_of(const Corners& triangle) {
  const auto [a, b, c] = triangle;
  const auto [west, east] = std::minmax({a.x, b.x, c.x});
  const auto [south, north] = std::minmax({a.y, b.y, c.y});
  return {west, south, east, north};
}

/// Some rows of a grid's cells, numbered as those of all of it: a place is in the same cell whichever rows are held.
struct RasterWindow {
  radar::GroundGrid grid;
  std::size_t first_row = 0, rows = 0;

  [[nodiscard]] radar::Rectangle extent() const {
    const double north_m = grid.north_m - static_cast<double>(first_row) * grid.cell_m;
    return {grid.west_m, north_m - static_cast<double>(rows) * grid.cell_m,
            grid.west_m + static_cast<double>(grid.columns) * grid.cell_m, north_m};
  }

  /// Calls `visit(column, row)` for those that a rectangle may cover.
  template <typename Visit>
  void for_cells_under(const radar::Rectangle& rectangle, const Visit& visit) const {
    const auto within = [](double cells, std::size_t from, std::size_t to) {
      return static_cast<std::size_t>(
          std::clamp(std::floor(cells), static_cast<double>(from), static_cast<double>(to)));
    };
    const Vec2d first = grid.cells_from({rectangle.west_m, rectangle.north_m}),
                last = grid.cells_from({rectangle.east_m, rectangle.south_m});
    const std::size_t north = within(first.y, first_row, first_row + rows),
                      south = within(last.y + 1.0, first_row, first_row + rows),
                      west = within(first.x, 0, grid.columns), east = within(last.x + 1.0, 0, grid.columns);
    for (std::size_t row = north; row < south; ++row) {
      for (std::size_t column = west; column < east; ++column) visit(column, row);
    }
  }
};

/// The parts of squares, so many along each side of one.
[[nodiscard]] inline radar::GroundGrid parts_of(const radar::GroundGrid& squares, std::size_t per_side) {
  return {squares.west_m, squares.north_m, squares.cell_m / static_cast<double>(per_side), squares.columns * per_side,
          squares.rows * per_side};
}

}  // namespace sigmascape::scene
