#include "sigmascape/terrain/height_field.h"

#include <algorithm>

namespace sigmascape::terrain {
namespace {

/// The cell that a point falls into and where in it; points outside are drawn to the edge.
struct CellPosition {
  std::size_t column, row;
  double u, v;  // 0..1 eastward and southward within the cell
};

CellPosition locate(const HeightField& field, Vec2d point) {
  const double across =
      std::clamp((point.x - field.west_m) / field.spacing_m, 0.0, static_cast<double>(field.height_m.columns() - 1));
  const double down =
      std::clamp((field.north_m - point.y) / field.spacing_m, 0.0, static_cast<double>(field.height_m.rows() - 1));
  const auto column = std::min(static_cast<std::size_t>(across), field.height_m.columns() - 2);
  const auto row = std::min(static_cast<std::size_t>(down), field.height_m.rows() - 2);
  return {column, row, across - static_cast<double>(column), down - static_cast<double>(row)};
}

}  // namespace

radar::Rectangle HeightField::extent() const {
  return {west_m, north_m - spacing_m * static_cast<double>(height_m.rows() - 1),
          west_m + spacing_m * static_cast<double>(height_m.columns() - 1), north_m};
}

double HeightField::height_at(Vec2d point) const {
  const auto [column, row, u, v] = locate(*this, point);
  const double north = (1.0 - u) * height_m(column, row) + u * height_m(column + 1, row);
  const double south = (1.0 - u) * height_m(column, row + 1) + u * height_m(column + 1, row + 1);
  return (1.0 - v) * north + v * south;
}

Vec3d HeightField::normal_at(Vec2d point) const {
  const auto [column, row, u, v] = locate(*this, point);
  const double north_west = height_m(column, row), north_east = height_m(column + 1, row);
  const double south_west = height_m(column, row + 1), south_east = height_m(column + 1, row + 1);
  const double slope_east = ((1.0 - v) * (north_east - north_west) + v * (south_east - south_west)) / spacing_m;
  const double slope_north = ((1.0 - u) * (north_west - south_west) + u * (north_east - south_east)) / spacing_m;
  return normalized(Vec3d{-slope_east, -slope_north, 1.0});
}

float HeightField::lowest_m() const {
  return *std::ranges::min_element(height_m.values());
}
float HeightField::highest_m() const {
  return *std::ranges::max_element(height_m.values());
}

}  // namespace sigmascape::terrain
