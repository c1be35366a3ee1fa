#include "sigmascape/product/reprojection.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <map>
#include <string>
#include <vector>

#include "sigmascape/base/error.h"
#include "sigmascape/geo/axis_units.h"
#include "sigmascape/geo/coordinate_reference_system.h"
#include "sigmascape/geo/coordinate_transform.h"
#include "sigmascape/product/described_map.h"

namespace sigmascape::product {
namespace {

using radar::Channels;

constexpr float no_value = std::numeric_limits<float>::quiet_NaN();

/// What a cell holds that nobody saw.
template <typename Value>
constexpr Value unseen{no_value};
template <>
constexpr Channels unseen<Channels>{no_value, no_value, no_value, no_value};

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

/// Side of a square that is as large, in the units of the system, as a cell at a place of the map.
double equal_cell(const geo::CoordinateTransform& transform, Vec2d place, double cell_m, double full_turn) {
  std::vector<Vec2d> corner{place, place + Vec2d{cell_m, 0.0}, place + Vec2d{0.0, cell_m}};
  transform.to_crs(corner);
  for (Vec2d& p : corner) p.x = geo::on_turn_of(p.x, corner.front().x, full_turn);
  const Vec2d east = corner[1] - corner[0], north = corner[2] - corner[0];
  return std::sqrt(std::abs(east.x * north.y - east.y * north.x));
}

/// That of a cell in the middle of the map, or of one a quarter away where a seam of the system tears the middle apart.
double equal_cell(const geo::CoordinateTransform& transform, const radar::GroundGrid& grid, double full_turn) {
  const radar::Rectangle extent = grid.extent();
  const Vec2d quarter{0.25 * extent.width_m(), 0.25 * extent.height_m()};
  const double middle = equal_cell(transform, extent.centre(), grid.cell_m, full_turn),
               beside = equal_cell(transform, extent.centre() - quarter, grid.cell_m, full_turn);
  return middle > 2.0 * beside ? beside : middle;
}

/// How a new cell is read from the old ones: of masks, and of classes that stand for names, there is no mean.
enum class Reading { Bilinear, Nearest };

/// NaN beyond the cells and, of a bilinear reading, where one of the four about the point is missing or unseen.
template <typename Value>
Value value_at(const radar::GroundGrid& grid, const Array2D<Value>& values, Vec2d point, Reading reading) {
  const Vec2d cells = grid.cells_from(point);
  const bool inside = cells.x >= 0.0 && cells.y >= 0.0 && cells.x <= static_cast<double>(grid.columns) &&
                      cells.y <= static_cast<double>(grid.rows);
  if (!inside) return unseen<Value>;
  const auto first = [](double position, std::size_t count) {
    return static_cast<std::size_t>(std::clamp(std::floor(position), 0.0, static_cast<double>(count - 1)));
  };
  if (reading == Reading::Nearest) return values(first(cells.x, grid.columns), first(cells.y, grid.rows));
  const double column = cells.x - 0.5, row = cells.y - 0.5;
  const std::size_t c = first(column, grid.columns), r = first(row, grid.rows);
  const std::size_t next_c = std::min(c + 1, grid.columns - 1), next_r = std::min(r + 1, grid.rows - 1);
  const auto u = static_cast<float>(std::clamp(column - static_cast<double>(c), 0.0, 1.0));
  const auto v = static_cast<float>(std::clamp(row - static_cast<double>(r), 0.0, 1.0));
  return values(c, r) * ((1.0F - u) * (1.0F - v)) + values(next_c, r) * (u * (1.0F - v)) +
         values(c, next_r) * ((1.0F - u) * v) + values(next_c, next_r) * (u * v);
}

/// The same cells where they keep their size in the frame that they are in already.
radar::GroundGrid turned_grid(const radar::GroundGrid& grid, const geo::LocalFrame& frame,
                              const geo::CoordinateTransform& transform, const std::string& crs,
                              std::optional<double> cell) {
  if (cell.value_or(grid.cell_m) == grid.cell_m && geo::is_same_crs(crs, frame.proj())) return grid;
  std::vector<Vec2d> outline = outline_of(grid.extent());
  transform.to_crs(outline);
  if (std::ranges::any_of(outline, [](Vec2d p) { return std::isnan(p.x) || std::isnan(p.y); })) {
    throw Error("coordinate system of the map", fmt::format("{} does not reach there", crs),
                "choose one that is made for the place");
  }
  // Across the meridian of 180° longitudes go on beyond it.
  const double turn = geo::full_turn(crs), first = outline.front().x;
  for (Vec2d& p : outline) p.x = geo::on_turn_of(p.x, first, turn);
  const radar::Rectangle box = box_about(outline);
  const double equal_side = equal_cell(transform, grid, turn), side = cell.value_or(equal_side);
  const auto cells = static_cast<double>(grid.columns * grid.rows);
  constexpr double most_times_as_large = 100.0;
  if (box.width_m() * box.height_m() > most_times_as_large * cells * equal_side * equal_side) {
    throw Error("coordinate system of the map", fmt::format("{} has a seam there that tears the map apart", crs),
                "choose one that is made for the place");
  }
  if (!(side > 0.0)) throw Error("cell of the map", fmt::format("{} is no size", side), "give a positive one");
  // The last cells may reach beyond the map, but by no rounding.
  const auto cells_over = [side](double length) { return static_cast<std::size_t>(std::ceil(length / side - 1e-6)); };
  return {box.west_m, box.north_m, side, cells_over(box.width_m()), cells_over(box.height_m())};
}

template <typename Value>
Array2D<Value> turned(const radar::GroundGrid& grid, const Array2D<Value>& values, const radar::GroundGrid& turned_grid,
                      const geo::CoordinateTransform& transform, Reading reading) {
  if (turned_grid == grid) return values;
  Array2D<Value> turned(turned_grid.columns, turned_grid.rows);
  std::vector<Vec2d> places(turned_grid.columns);
  for (std::size_t row = 0; row < turned_grid.rows; ++row) {
    for (std::size_t column = 0; column < places.size(); ++column) places[column] = turned_grid.centre_of(column, row);
    transform.to_frame(places);
    for (std::size_t column = 0; column < places.size(); ++column)
      turned(column, row) = value_at(grid, values, places[column], reading);
  }
  return turned;
}

/// Positions that are told, as the radar's, stay in the local frame, which the system of the map no longer names.
std::map<std::string, std::string> with_frame(std::map<std::string, std::string> metadata,
                                              const geo::LocalFrame& frame) {
  metadata[local_frame_key] = frame.proj();
  return metadata;
}

geo::CoordinateTransform transform_to(const std::string& crs, const geo::LocalFrame& frame) {
  return {crs, frame, "coordinate system of the map"};
}

}  // namespace

radar::GroundMap reprojected(const radar::GroundMap& map, const geo::LocalFrame& frame, const std::string& crs,
                             std::optional<double> cell) {
  const auto transform = transform_to(crs, frame);
  const radar::GroundGrid grid = turned_grid(map.grid, frame, transform, crs, cell);
  return {.grid = grid,
          .sigma0 = turned(map.grid, map.sigma0, grid, transform, Reading::Bilinear),
          .crs = crs,
          .metadata = with_frame(map.metadata, frame)};
}

radar::GroundGrid reprojected(const radar::GroundGrid& grid, const geo::LocalFrame& frame, const std::string& crs,
                              std::optional<double> cell) {
  return turned_grid(grid, frame, transform_to(crs, frame), crs, cell);
}

radar::PowerMap reprojected(const radar::PowerMap& map, const geo::LocalFrame& frame, const std::string& crs,
                            std::optional<double> cell) {
  const auto transform = transform_to(crs, frame);
  const radar::GroundGrid grid = turned_grid(map.grid, frame, transform, crs, cell);
  return {.grid = grid,
          .power_w = turned(map.grid, map.power_w, grid, transform, Reading::Bilinear),
          .noise_w = map.noise_w,
          .crs = crs,
          .metadata = with_frame(map.metadata, frame)};
}

radar::LayerStack reprojected(const radar::LayerStack& stack, const geo::LocalFrame& frame, const std::string& crs,
                              std::optional<double> cell) {
  const auto transform = transform_to(crs, frame);
  const radar::GroundGrid grid = turned_grid(stack.grid, frame, transform, crs, cell);
  radar::LayerStack result{.grid = grid, .layers = {}, .crs = crs, .metadata = with_frame(stack.metadata, frame)};
  for (const radar::Layer& layer : stack.layers) {
    const Reading reading = layer.unit.empty() ? Reading::Nearest : Reading::Bilinear;
    result.layers.push_back(
        {layer.name, layer.unit, turned(stack.grid, layer.values, grid, transform, reading), layer.is_classes});
  }
  return result;
}

}  // namespace sigmascape::product
