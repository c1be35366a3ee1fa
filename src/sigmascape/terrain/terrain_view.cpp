#include "sigmascape/terrain/terrain_view.h"

#include <algorithm>

namespace sigmascape::terrain {
namespace {

/// Along one side of a view: the cell that a place in nodes of the lattice lies in, and how far into it.
struct CellAlong {
  std::size_t cell;
  double part;

  CellAlong(double place, std::int64_t first_node, std::size_t nodes) {
    const auto first = static_cast<double>(first_node);
    const double inside = std::clamp(place, first, first + static_cast<double>(nodes - 1));
    cell = std::min(static_cast<std::size_t>(inside - first), nodes - 2);
    part = inside - (first + static_cast<double>(cell));
  }
};

/// Between the values of the four nodes about a place, `at(node)` each.
template <typename At>
double between(const TerrainView& view, const PlaceInCell& place, const At& at) {
  const std::size_t north_west = place.north_west, south_west = north_west + view.columns;
  const double north = (1.0 - place.u) * at(north_west) + place.u * at(north_west + 1);
  const double south = (1.0 - place.u) * at(south_west) + place.u * at(south_west + 1);
  return (1.0 - place.v) * north + place.v * south;
}

}  // namespace

PlaceInCell place_in_cell(const TerrainView& view, Vec2d point) {
  const Vec2d nodes = view.nodes_to(point);
  const CellAlong column(nodes.x, view.first_column, view.columns), row(nodes.y, view.first_row, view.rows);
  return {row.cell * view.columns + column.cell, column.part, row.part};
}

double height_at(const TerrainView& view, Vec2d point) {
  return between(view, place_in_cell(view, point),
                 [&](std::size_t node) { return static_cast<double>(view.height_m[node]); });
}

Vec2d slope_at(const TerrainView& view, Vec2d point) {
  const PlaceInCell place = place_in_cell(view, point);
  if (!view.slope.empty()) {
    constexpr auto per_step = static_cast<double>(1.0F / PackedSlope::steps_per_unit);
    return {between(view, place, [&](std::size_t node) { return per_step * view.slope[node].east; }),
            between(view, place, [&](std::size_t node) { return per_step * view.slope[node].north; })};
  }
  const auto height = [&](std::size_t node) { return static_cast<double>(view.height_m[node]); };
  const std::size_t upper = place.north_west, lower = upper + view.columns;
  const double north_west = height(upper), north_east = height(upper + 1);
  const double south_west = height(lower), south_east = height(lower + 1);
  return {((1.0 - place.v) * (north_east - north_west) + place.v * (south_east - south_west)) / view.spacing_m,
          ((1.0 - place.u) * (north_west - south_west) + place.u * (north_east - south_east)) / view.spacing_m};
}

TerrainView view_of(const HeightField& field) {
  return {.lattice_west_m = field.west_m,
          .lattice_north_m = field.north_m,
          .spacing_m = field.spacing_m,
          .columns = field.height_m.columns(),
          .rows = field.height_m.rows(),
          .height_m = field.height_m.values(),
          .lowest_m = field.lowest_m(),
          .highest_m = field.highest_m()};
}

}  // namespace sigmascape::terrain
