#include "sigmascape/trace/ground_within.h"

#include <algorithm>
#include <cmath>

namespace sigmascape::trace {
namespace {

/// Some of a row of things, first … first + count − 1.
struct Run {
  std::size_t first, count;
};

/// Those from the one that `begin` lies in to the one that `end` lies in, of `of`, and `at_least` so many.
Run run_between(double begin, double end, std::size_t of, std::size_t at_least) {
  if (of <= at_least) return {0, of};
  const auto last_first = static_cast<double>(of - at_least);
  const auto first = static_cast<std::size_t>(std::clamp(std::floor(begin), 0.0, last_first));
  const double after =
      std::clamp(std::floor(end) + 1.0, static_cast<double>(first + at_least), static_cast<double>(of));
  return {first, static_cast<std::size_t>(after) - first};
}

/// The nodes that a field's surface over a rectangle hangs on.
struct NodeRuns {
  Run columns, rows;
};
NodeRuns nodes_within(const terrain::HeightField& field, const radar::Rectangle& part) {
  const auto nodes = [&field](double metres) { return metres / field.spacing_m; };
  // A cell hangs on the node after it as well.
  return {run_between(nodes(part.west_m - field.west_m), nodes(part.east_m - field.west_m) + 1.0,
                      field.height_m.columns(), 2),
          run_between(nodes(field.north_m - part.north_m), nodes(field.north_m - part.south_m) + 1.0,
                      field.height_m.rows(), 2)};
}

template <typename Value>
Array2D<Value> piece(const Array2D<Value>& whole, Run columns, Run rows) {
  Array2D<Value> part(columns.count, rows.count);
  for (std::size_t row = 0; row < rows.count; ++row)
    std::ranges::copy(whole.row(rows.first + row).subspan(columns.first, columns.count), part.row(row).begin());
  return part;
}

}  // namespace

terrain::HeightField ground_within(const terrain::HeightField& field, const radar::Rectangle& part) {
  const auto [columns, rows] = nodes_within(field, part);
  return {.west_m = field.west_m + static_cast<double>(columns.first) * field.spacing_m,
          .north_m = field.north_m - static_cast<double>(rows.first) * field.spacing_m,
          .spacing_m = field.spacing_m,
          .height_m = piece(field.height_m, columns, rows)};
}

std::size_t heights_within(const terrain::HeightField& field, const radar::Rectangle& part) {
  const auto [columns, rows] = nodes_within(field, part);
  return columns.count * rows.count;
}

scene::MaterialMap ground_within(const scene::MaterialMap& map, const radar::Rectangle& part) {
  const radar::GroundGrid& grid = map.grid;
  const Vec2d first = grid.cells_from({part.west_m, part.north_m}), last = grid.cells_from({part.east_m, part.south_m});
  const Run columns = run_between(first.x, last.x, grid.columns, 1), rows = run_between(first.y, last.y, grid.rows, 1);
  return {
      .grid = {grid.west_m + static_cast<double>(columns.first) * grid.cell_m,
               grid.north_m - static_cast<double>(rows.first) * grid.cell_m, grid.cell_m, columns.count, rows.count},
      .material = piece(map.material, columns, rows)};
}

}  // namespace sigmascape::trace
