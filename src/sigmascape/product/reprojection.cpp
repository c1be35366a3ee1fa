#include "sigmascape/product/reprojection.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <utility>
#include <vector>

#include "sigmascape/base/error.h"
#include "sigmascape/geo/coordinate_transform.h"

namespace sigmascape::product {
namespace {

using radar::Channels;

constexpr float unseen = std::numeric_limits<float>::quiet_NaN();

/// Points along the four sides of a rectangle: a straight side may become a bow.
std::vector<Vec2d> outline_of(const radar::Rectangle& area) {
  constexpr int pieces = 32;
  std::vector<Vec2d> points;
  for (int i = 0; i <= pieces; ++i) {
    const double part = static_cast<double>(i) / pieces;
    const double x = std::lerp(area.west_m, area.east_m, part), y = std::lerp(area.south_m, area.north_m, part);
    points.insert(points.end(), {{x, area.south_m}, {x, area.north_m}, {area.west_m, y}, {area.east_m, y}});
  }
  return points;
}

radar::Rectangle box_about(const std::vector<Vec2d>& points) {
  radar::Rectangle box{points[0].x, points[0].y, points[0].x, points[0].y};
  for (const Vec2d& p : points) {
    box = {std::min(box.west_m, p.x), std::min(box.south_m, p.y), std::max(box.east_m, p.x),
           std::max(box.north_m, p.y)};
  }
  return box;
}

/// Side of a square that is as large, in the units of the system, as a cell in the middle of the map.
double equal_cell(const geo::CoordinateTransform& transform, const radar::GroundGrid& grid) {
  const Vec2d middle = grid.extent().centre();
  std::vector<Vec2d> corner{middle, middle + Vec2d{grid.cell_m, 0.0}, middle + Vec2d{0.0, grid.cell_m}};
  transform.to_crs(corner);
  const Vec2d east = corner[1] - corner[0], north = corner[2] - corner[0];
  return std::sqrt(std::abs(east.x * north.y - east.y * north.x));
}

/// NaN where one of the four cells about the point is missing or unseen.
Channels value_at(const radar::GroundGrid& grid, const Array2D<Channels>& values, Vec2d point) {
  const Vec2d cells = grid.cells_from(point);
  const double column = cells.x - 0.5, row = cells.y - 0.5;
  const bool inside = cells.x >= 0.0 && cells.y >= 0.0 && cells.x <= static_cast<double>(grid.columns) &&
                      cells.y <= static_cast<double>(grid.rows);
  if (!inside) return {unseen, unseen, unseen, unseen};
  const auto first = [](double position, std::size_t count) {
    return static_cast<std::size_t>(std::clamp(std::floor(position), 0.0, static_cast<double>(count - 1)));
  };
  const std::size_t c = first(column, grid.columns), r = first(row, grid.rows);
  const std::size_t next_c = std::min(c + 1, grid.columns - 1), next_r = std::min(r + 1, grid.rows - 1);
  const auto u = static_cast<float>(std::clamp(column - static_cast<double>(c), 0.0, 1.0));
  const auto v = static_cast<float>(std::clamp(row - static_cast<double>(r), 0.0, 1.0));
  return values(c, r) * ((1.0F - u) * (1.0F - v)) + values(next_c, r) * (u * (1.0F - v)) +
         values(c, next_r) * ((1.0F - u) * v) + values(next_c, next_r) * (u * v);
}

/// Cells and where they lie.
struct PlacedCells {
  radar::GroundGrid grid;
  Array2D<Channels> values;
};

radar::GroundGrid turned_grid(const radar::GroundGrid& grid, const geo::CoordinateTransform& transform,
                              const std::string& crs, std::optional<double> cell) {
  std::vector<Vec2d> outline = outline_of(grid.extent());
  transform.to_crs(outline);
  if (std::ranges::any_of(outline, [](Vec2d p) { return std::isnan(p.x) || std::isnan(p.y); })) {
    throw Error("coordinate system of the map", fmt::format("{} does not reach there", crs),
                "choose one that is made for the place");
  }
  const radar::Rectangle box = box_about(outline);
  const double side = cell.value_or(equal_cell(transform, grid));
  if (!(side > 0.0)) throw Error("cell of the map", fmt::format("{} is no size", side), "give a positive one");
  return {box.west_m, box.north_m, side, static_cast<std::size_t>(std::ceil(box.width_m() / side)),
          static_cast<std::size_t>(std::ceil(box.height_m() / side))};
}

PlacedCells turned(const radar::GroundGrid& grid, const Array2D<Channels>& values, const geo::LocalFrame& frame,
                   const std::string& crs, std::optional<double> cell) {
  const geo::CoordinateTransform transform(crs, frame, "coordinate system of the map");
  PlacedCells turned{.grid = turned_grid(grid, transform, crs, cell), .values = {}};
  turned.values = Array2D<Channels>(turned.grid.columns, turned.grid.rows);
  std::vector<Vec2d> places(turned.grid.columns);
  for (std::size_t row = 0; row < turned.grid.rows; ++row) {
    for (std::size_t column = 0; column < places.size(); ++column) places[column] = turned.grid.centre_of(column, row);
    transform.to_frame(places);
    for (std::size_t column = 0; column < places.size(); ++column)
      turned.values(column, row) = value_at(grid, values, places[column]);
  }
  return turned;
}

}  // namespace

radar::GroundMap reprojected(const radar::GroundMap& map, const geo::LocalFrame& frame, const std::string& crs,
                             std::optional<double> cell) {
  PlacedCells cells = turned(map.grid, map.sigma0, frame, crs, cell);
  return {.grid = cells.grid, .sigma0 = std::move(cells.values), .crs = crs, .metadata = map.metadata};
}

radar::PowerMap reprojected(const radar::PowerMap& map, const geo::LocalFrame& frame, const std::string& crs,
                            std::optional<double> cell) {
  PlacedCells cells = turned(map.grid, map.power_w, frame, crs, cell);
  return {.grid = cells.grid,
          .power_w = std::move(cells.values),
          .noise_w = map.noise_w,
          .crs = crs,
          .metadata = map.metadata};
}

}  // namespace sigmascape::product
