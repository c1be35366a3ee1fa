#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "sigmascape/base/vec.h"
#include "sigmascape/radar/ground_grid.h"

namespace sigmascape::scene {

/// Corners of a convex outline, counter-clockwise, in metres.
using ConvexPolygon = std::vector<Vec2d>;

[[nodiscard]] double area_m2(const ConvexPolygon& polygon);
/// The mean of the corners: a point inside.
[[nodiscard]] Vec2d middle_of(const ConvexPolygon& polygon);
/// The part to the left of the line through `on_line` along `direction`; empty when there is none.
[[nodiscard]] ConvexPolygon left_part(const ConvexPolygon& polygon, Vec2d on_line, Vec2d direction);
/// The polygon with every edge moved inward; empty when nothing is left.
[[nodiscard]] ConvexPolygon inset(const ConvexPolygon& polygon, double distance_m);
/// The rectangle around a centre, `length_m` along the unit vector `along` and `width_m` across it.
[[nodiscard]] ConvexPolygon oriented_rectangle(Vec2d centre, Vec2d along, double length_m, double width_m);
/// The straight strip from `from` to `to`, extended at both ends by its half width so that strips of a bent line join.
[[nodiscard]] ConvexPolygon strip(Vec2d from, Vec2d to, double half_width_m);

struct PartitionOptions {
  double target_area_m2 = 8000.0;
  /// Pieces larger than this turn their axes against each other, smaller ones keep those of the piece they came from.
  double district_area_m2 = 120'000.0;
  double district_turn_rad = 0.25;
  double axis_jitter_rad = 0.03;
};

/// Cuts a polygon in two, again and again, across its longer side, until the pieces have about the target area: parcels
/// with straight borders, as fields and town blocks have them.
[[nodiscard]] std::vector<ConvexPolygon> partitioned(const ConvexPolygon& polygon, double axis_rad,
                                                     const PartitionOptions& options, std::uint64_t seed);

/// Calls `visit(column, row)` for every cell of the grid whose centre lies in the polygon.
template <typename Visit>
void for_each_cell(const radar::GroundGrid& grid, const ConvexPolygon& polygon, const Visit& visit) {
  double lowest = std::numeric_limits<double>::infinity(), highest = -lowest;
  for (const Vec2d corner : polygon) {
    const double row = grid.cells_from(corner).y;
    lowest = std::min(lowest, row);
    highest = std::max(highest, row);
  }
  const auto first_at = [](double edge) { return static_cast<std::size_t>(std::max(0.0, std::ceil(edge - 0.5))); };
  const auto end_at = [](double edge, std::size_t count) {
    return static_cast<std::size_t>(std::clamp(std::floor(edge - 0.5) + 1.0, 0.0, static_cast<double>(count)));
  };
  for (std::size_t row = first_at(lowest); row < end_at(highest, grid.rows); ++row) {
    const double level = static_cast<double>(row) + 0.5;
    double left = std::numeric_limits<double>::infinity(), right = -left;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const Vec2d a = grid.cells_from(polygon[i]), b = grid.cells_from(polygon[(i + 1) % polygon.size()]);
      if ((a.y <= level) == (b.y <= level)) continue;
      const double crossing = a.x + (level - a.y) / (b.y - a.y) * (b.x - a.x);
      left = std::min(left, crossing);
      right = std::max(right, crossing);
    }
    if (left > right) continue;
    for (std::size_t column = first_at(left); column < end_at(right, grid.columns); ++column) visit(column, row);
  }
}

}  // namespace sigmascape::scene
