#include "sigmascape/terrain/terrain_view.h"

#include <algorithm>

namespace sigmascape::terrain {
namespace {

/// The four nodes about a point and where between them it lies; points outside are drawn to the edge.
struct NodesAbout {
  std::size_t north_west, south_west;
  double u, v;  // 0..1 eastward and southward

  NodesAbout(const TerrainView& view, Vec2d point) {
    const double across =
        std::clamp((point.x - view.west_m) / view.spacing_m, 0.0, static_cast<double>(view.columns - 1));
    const double down = std::clamp((view.north_m - point.y) / view.spacing_m, 0.0, static_cast<double>(view.rows - 1));
    const auto column = std::min(static_cast<std::size_t>(across), view.columns - 2);
    const auto row = std::min(static_cast<std::size_t>(down), view.rows - 2);
    north_west = row * view.columns + column;
    south_west = north_west + view.columns;
    u = across - static_cast<double>(column);
    v = down - static_cast<double>(row);
  }

  /// Between four values, `at(node)` each.
  template <typename At>
  [[nodiscard]] double between(const At& at) const {
    const double north = (1.0 - u) * at(north_west) + u * at(north_west + 1);
    const double south = (1.0 - u) * at(south_west) + u * at(south_west + 1);
    return (1.0 - v) * north + v * south;
  }
};

}  // namespace

double height_at(const TerrainView& view, Vec2d point) {
  return NodesAbout(view, point).between([&](std::size_t node) { return static_cast<double>(view.height_m[node]); });
}

Vec2d slope_at(const TerrainView& view, Vec2d point) {
  const NodesAbout nodes(view, point);
  if (!view.slope.empty()) {
    constexpr auto per_step = static_cast<double>(1.0F / PackedSlope::steps_per_unit);
    return {nodes.between([&](std::size_t node) { return per_step * view.slope[node].east; }),
            nodes.between([&](std::size_t node) { return per_step * view.slope[node].north; })};
  }
  const auto height = [&](std::size_t node) { return static_cast<double>(view.height_m[node]); };
  const double north_west = height(nodes.north_west), north_east = height(nodes.north_west + 1);
  const double south_west = height(nodes.south_west), south_east = height(nodes.south_west + 1);
  return {((1.0 - nodes.v) * (north_east - north_west) + nodes.v * (south_east - south_west)) / view.spacing_m,
          ((1.0 - nodes.u) * (north_west - south_west) + nodes.u * (north_east - south_east)) / view.spacing_m};
}

TerrainView view_of(const HeightField& field) {
  return {.west_m = field.west_m,
          .north_m = field.north_m,
          .spacing_m = field.spacing_m,
          .columns = field.height_m.columns(),
          .rows = field.height_m.rows(),
          .height_m = field.height_m.values(),
          .lowest_m = field.lowest_m(),
          .highest_m = field.highest_m()};
}

}  // namespace sigmascape::terrain
