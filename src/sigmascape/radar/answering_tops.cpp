#include "sigmascape/radar/answering_tops.h"

#include <algorithm>
#include <span>
#include <vector>

namespace sigmascape::radar {
namespace {

/// Terrain hides what is looked at less steeply than it falls, and little of what is built on falls by more than this.
constexpr double layover_a_height = 0.25;

/// Along one line of squares: the highest that reaches each of them.
void spread(std::span<const float> tops_m, double cell_m, std::span<float> reaching_m) {
  std::ranges::fill(reaching_m, 0.0F);
  for (std::size_t i = 0; i < tops_m.size(); ++i) {
    if (!(tops_m[i] > 0.0F)) continue;
    const std::size_t reach = layover_squares(static_cast<double>(tops_m[i]), cell_m);
    const std::size_t end = std::min(i + reach + 1, tops_m.size());
    for (std::size_t j = i - std::min(i, reach); j < end; ++j) reaching_m[j] = std::max(reaching_m[j], tops_m[i]);
  }
}

}  // namespace

std::size_t layover_squares(double top_m, double cell_m) {
  return 1 + static_cast<std::size_t>(layover_a_height * top_m / cell_m);
}

/// Rows first and then columns: the higher reaches farther, so that what is lost to it in a row would be lost anyway.
Array2D<float> overlying_tops_m(const Array2D<float>& standing_m, double cell_m) {
  Array2D<float> overlying_m(standing_m.columns(), standing_m.rows());
  for (std::size_t row = 0; row < standing_m.rows(); ++row) spread(standing_m.row(row), cell_m, overlying_m.row(row));
  std::vector<float> line(standing_m.rows()), reaching(standing_m.rows());
  for (std::size_t column = 0; column < standing_m.columns(); ++column) {
    for (std::size_t row = 0; row < line.size(); ++row) line[row] = overlying_m(column, row);
    spread(line, cell_m, reaching);
    for (std::size_t row = 0; row < line.size(); ++row) overlying_m(column, row) = reaching[row];
  }
  return overlying_m;
}

void add_what_comes_from_afar(std::span<float> top_m, FromAfar from_afar) {
  if (from_afar == FromAfar::Unhidden) std::ranges::replace(top_m, 0.0F, from_afar_m);
}

AnsweringTops answering_tops(const ObstacleMap& map, FromAfar from_afar) {
  Array2D<float> standing_m(map.obstacles.columns(), map.obstacles.rows());
  for (std::size_t i = 0; i < standing_m.size(); ++i) standing_m.values()[i] = map.obstacles.values()[i].top_m();
  AnsweringTops tops{map.grid, overlying_tops_m(standing_m, map.grid.cell_m)};
  add_what_comes_from_afar(tops.top_m.values(), from_afar);
  return tops;
}

}  // namespace sigmascape::radar
