#include "sigmascape/bake/highest_ground.h"

#include <algorithm>
#include <limits>

namespace sigmascape::bake {
namespace {

/// Squares of one level along a side of those of the next.
constexpr std::size_t per_side = 4;

std::size_t squares_over(std::size_t finer) {
  return (finer + per_side - 1) / per_side;
}

/// Of squares each of which holds `per_side`² finer ones, so many of them; `highest_m(column, row)` of a finer one.
template <typename Highest>
Array2D<float> level_over(std::size_t columns, std::size_t rows, const Highest& highest_m) {
  Array2D<float> level(squares_over(columns), squares_over(rows), std::numeric_limits<float>::lowest());
  for (std::size_t row = 0; row < rows; ++row) {
    for (std::size_t column = 0; column < columns; ++column) {
      float& square_m = level(column / per_side, row / per_side);
      square_m = std::max(square_m, static_cast<float>(highest_m(column, row)));
    }
  }
  return level;
}

}  // namespace

HighestGround::HighestGround(const terrain::HeightField& relief) : relief_(relief) {
  const auto of_cell = [&](std::size_t column, std::size_t row) { return highest_of_cell_m(column, row); };
  above_cells_.push_back(level_over(relief.height_m.columns() - 1, relief.height_m.rows() - 1, of_cell));
  while (above_cells_.back().size() > 1) {
    const Array2D<float>& finer = above_cells_.back();
    above_cells_.push_back(level_over(finer.columns(), finer.rows(), finer));
  }
}

double HighestGround::highest_m() const {
  return static_cast<double>(above_cells_.back()(0, 0));
}

double HighestGround::highest_of_cell_m(std::size_t column, std::size_t row) const {
  const Array2D<float>& heights = relief_.height_m;
  return static_cast<double>(std::max(
      {heights(column, row), heights(column + 1, row), heights(column, row + 1), heights(column + 1, row + 1)}));
}

HighestGround::Square HighestGround::around(Vec2d point, std::size_t level) const {
  std::size_t cells = 1;  // along a side
  for (std::size_t i = 0; i < level; ++i) cells *= per_side;
  const double side_m = relief_.spacing_m * static_cast<double>(cells);
  const auto place = [&](double from_edge_m, std::size_t nodes) {
    return std::min(static_cast<std::size_t>(std::max(from_edge_m, 0.0) / side_m), (nodes - 2) / cells);
  };
  const std::size_t column = place(point.x - relief_.west_m, relief_.height_m.columns());
  const std::size_t row = place(relief_.north_m - point.y, relief_.height_m.rows());
  const double west_m = relief_.west_m + static_cast<double>(column) * side_m;
  const double north_m = relief_.north_m - static_cast<double>(row) * side_m;
  const double highest_m =
      level == 0 ? highest_of_cell_m(column, row) : static_cast<double>(above_cells_[level - 1](column, row));
  return {{west_m, north_m - side_m, west_m + side_m, north_m}, highest_m};
}

}  // namespace sigmascape::bake
