#include "sigmascape/radar/obstacle.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <span>
#include <vector>

#include "sigmascape/radar/lines_across.h"

namespace sigmascape::radar {
namespace {

using Quarters = std::array<const Obstacle*, 4>;  // north-west, north-east, south-west, south-east

/// The optical depth across the square that the quarters form, for lines along its rows and columns at all heights:
/// between two of the sorted `edges_m` of crowns it is always the same.
double depth_across(const Quarters& quarters, double side_m, std::span<const float> edges_m) {
  LinesAcross eastward, northward;
  for (std::size_t edge = 1; edge < edges_m.size(); ++edge) {
    const float from_m = edges_m[edge - 1], to_m = edges_m[edge];
    const auto depth_along = [&](std::size_t one, std::size_t other) {
      double depth = 0.0;
      for (const std::size_t quarter : {one, other}) {
        const Obstacle& crown = *quarters[quarter];
        if (crown.crown_base_m <= from_m && crown.crown_top_m >= to_m)
          depth += static_cast<double>(crown.crown_extinction_per_m) * side_m;
      }
      return depth;
    };
    const auto height_m = static_cast<double>(to_m - from_m);
    for (const double depth : {depth_along(0, 1), depth_along(2, 3)}) eastward.add(depth, depth, height_m);
    for (const double depth : {depth_along(0, 2), depth_along(1, 3)}) northward.add(depth, depth, height_m);
  }
  return (eastward.depth() + northward.depth()) / 2.0;
}

/// From mean base to mean top, each weighted by its crown's depth upwards. A crown that is lower than the space which
/// the quarters' crowns take up together is that much denser.
void merge_crowns(const Quarters& quarters, double side_m, Obstacle& all) {
  LinesAcross upward;
  double depth_upwards = 0.0, base = 0.0, top = 0.0;
  std::vector<float> edges_m;
  for (const Obstacle* quarter : quarters) {
    const auto& [solid_top_m, crown_base_m, crown_top_m, crown_extinction_per_m] = *quarter;
    if (!(crown_top_m > crown_base_m) || crown_extinction_per_m == 0.0F) {
      upward.add(0.0, 0.0);
      continue;
    }
    const auto base_m = static_cast<double>(crown_base_m), top_m = static_cast<double>(crown_top_m);
    const double depth = static_cast<double>(crown_extinction_per_m) * (top_m - base_m);
    upward.add(depth, depth);
    depth_upwards += depth;
    base += depth * base_m;
    top += depth * top_m;
    edges_m.insert(edges_m.end(), {crown_base_m, crown_top_m});
  }
  if (edges_m.empty()) return;
  const auto base_m = static_cast<float>(base / depth_upwards), top_m = static_cast<float>(top / depth_upwards);
  if (!(top_m > base_m)) return;  // too thin to tell
  std::ranges::sort(edges_m);
  const double depth = depth_across(quarters, side_m, edges_m);
  const double height_m = static_cast<double>(edges_m.back()) - static_cast<double>(edges_m.front());
  all.crown_base_m = base_m;
  all.crown_top_m = top_m;
  all.crown_extinction_per_m = static_cast<float>((depth / side_m * height_m + upward.depth()) / 3.0 /
                                                  (static_cast<double>(top_m) - static_cast<double>(base_m)));
}

}  // namespace

Obstacle merged(const Obstacle& north_west, const Obstacle& north_east, const Obstacle& south_west,
                const Obstacle& south_east, double side_m) {
  const auto greater = [](const Obstacle& a, const Obstacle& b) { return std::max(a.solid_top_m, b.solid_top_m); };
  Obstacle all;
  all.solid_top_m = 0.25F * (greater(north_west, north_east) + greater(south_west, south_east) +
                             greater(north_west, south_west) + greater(north_east, south_east));
  merge_crowns({&north_west, &north_east, &south_west, &south_east}, side_m, all);
  return all;
}

ObstacleMap halved(const ObstacleMap& finer) {
  const auto& [squares, of] = finer;
  assert(of.columns() % 2 == 0 && of.rows() % 2 == 0);
  ObstacleMap coarser{{squares.west_m, squares.north_m, 2.0 * squares.cell_m, of.columns() / 2, of.rows() / 2},
                      Array2D<Obstacle>(of.columns() / 2, of.rows() / 2)};
  for (std::size_t row = 0; row < coarser.obstacles.rows(); ++row) {
    for (std::size_t column = 0; column < coarser.obstacles.columns(); ++column) {
      coarser.obstacles(column, row) =
          merged(of(2 * column, 2 * row), of(2 * column + 1, 2 * row), of(2 * column, 2 * row + 1),
                 of(2 * column + 1, 2 * row + 1), squares.cell_m);
    }
  }
  return coarser;
}

}  // namespace sigmascape::radar
