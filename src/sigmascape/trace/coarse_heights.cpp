#include "sigmascape/trace/coarse_heights.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "sigmascape/radar/rectangle_parts.h"

namespace sigmascape::trace {
namespace {

constexpr float endless = std::numeric_limits<float>::infinity();

using Interval = CoarseHeights::Interval;

void widen(Interval& interval, const Interval& other) {
  interval.lowest_m = std::min(interval.lowest_m, other.lowest_m);
  interval.highest_m = std::max(interval.highest_m, other.highest_m);
}

/// What a prototype fills about its origin, however it is turned.
struct Hull {
  float radius_m = 0.0F;
  Interval heights{0.0F, 0.0F};
};

std::vector<Hull> hulls_of(const scene::Scene& scene) {
  const std::vector<float> radii = scene::prototype_radii_m(scene);
  std::vector<Hull> hulls(scene.prototypes.size());
  for (std::size_t i = 0; i < hulls.size(); ++i) {
    hulls[i].radius_m = radii[i];
    for (const Vec3f& v : scene.prototypes[i].vertices) widen(hulls[i].heights, {v.z, v.z});
  }
  for (const scene::Crown& crown : scene.crowns) {
    const auto& [centre, radii_m] = crown.shape;
    widen(hulls[crown.prototype].heights, {centre.z - radii_m.z, centre.z + radii_m.z});
  }
  return hulls;
}

radar::GroundGrid squares_over(const radar::Rectangle& region, double square_m) {
  const auto count = [square_m](double metres) { return static_cast<std::size_t>(std::ceil(metres / square_m)) + 1; };
  return {region.west_m, region.north_m, square_m, count(region.width_m()), count(region.height_m())};
}

/// The place of a number among `count` of them.
std::size_t within(double number, std::size_t count) {
  return static_cast<std::size_t>(std::clamp(std::floor(number), 0.0, static_cast<double>(count - 1)));
}

}  // namespace

CoarseHeights::CoarseHeights(const scene::Scene& scene, Footing footing, radar::Rectangle region, double square_m)
    : grid_(squares_over(region, square_m)), heights_(grid_.columns, grid_.rows, {0.0F, 0.0F}) {
  if (footing == Footing::Terrain) {
    for (std::size_t row = 0; row < grid_.rows; ++row) {
      for (std::size_t column = 0; column < grid_.columns; ++column)
        heights_(column, row) = ground_in(scene.terrain, column, row);
    }
  }
  add_instances(scene, footing);
  add_buildings(scene.buildings, footing);
  grow();
  highest_m_ = std::ranges::max(heights_.values(), {}, &Interval::highest_m).highest_m;
}

const Interval* CoarseHeights::around(Vec2d point) const {
  const Vec2d at = grid_.cells_from(point);
  const bool is_inside =
      at.x >= 0.0 && at.y >= 0.0 && at.x < static_cast<double>(grid_.columns) && at.y < static_cast<double>(grid_.rows);
  return is_inside ? &heights_(static_cast<std::size_t>(at.x), static_cast<std::size_t>(at.y)) : nullptr;
}

/// Ground between nodes lies between their heights; beyond the field it is as high as its edge.
Interval CoarseHeights::ground_in(const terrain::HeightField& field, std::size_t column, std::size_t row) const {
  const auto nodes = [&](double metres, std::size_t count) {
    const double first = metres / field.spacing_m, last = (metres + grid_.cell_m) / field.spacing_m;
    return std::pair(within(first, count), within(last + 1.0, count));
  };
  const double west = grid_.west_m + static_cast<double>(column) * grid_.cell_m;
  const double north = grid_.north_m - static_cast<double>(row) * grid_.cell_m;
  const auto [left, right] = nodes(west - field.west_m, field.height_m.columns());
  const auto [upper, lower] = nodes(field.north_m - north, field.height_m.rows());
  Interval heights{endless, -endless};
  for (std::size_t y = upper; y <= lower; ++y) {
    for (std::size_t x = left; x <= right; ++x) widen(heights, {field.height_m(x, y), field.height_m(x, y)});
  }
  return heights;
}

void CoarseHeights::add_instances(const scene::Scene& scene, Footing footing) {
  const std::vector<Hull> hulls = hulls_of(scene);
  const radar::Rectangle extent = grid_.extent();
  for (const scene::Instance& instance : scene.instances) {
    const Hull& hull = hulls[instance.prototype];
    const double radius = static_cast<double>(hull.radius_m * std::max(instance.scale.x, instance.scale.y));
    const double x = static_cast<double>(instance.x_m), y = static_cast<double>(instance.y_m);
    const radar::Rectangle box = radar::widened({x, y, x, y}, radius);
    if (!radar::meet(box, extent)) continue;  // of a large scene nearly all, and to find their ground takes long
    const double ground = footing == Footing::Terrain ? scene.terrain.height_at({x, y}) : 0.0;
    const float foot = static_cast<float>(ground) + instance.lift_m;
    add_box(box, {foot + hull.heights.lowest_m * instance.scale.z, foot + hull.heights.highest_m * instance.scale.z});
  }
}

void CoarseHeights::add_buildings(const scene::Buildings& buildings, Footing footing) {
  const radar::Rectangle extent = grid_.extent();
  for (const scene::Building& building : buildings.items) {
    const radar::Rectangle box = scene::extent_of(buildings, building);
    if (!radar::meet(box, extent)) continue;
    Interval heights{endless, -endless};
    const float foot = footing == Footing::Terrain ? building.footing_m : 0.0F;
    for (std::uint32_t i = 0; i < building.vertex_count; ++i) {
      const Vec3f& v = buildings.mesh.vertices[building.first_vertex + i];
      widen(heights, {foot + v.z, foot + v.z});
    }
    add_box(box, heights);
  }
}

void CoarseHeights::add_box(const radar::Rectangle& box, Interval heights) {
  const Vec2d first = grid_.cells_from({box.west_m, box.north_m}), last = grid_.cells_from({box.east_m, box.south_m});
  for (std::size_t row = within(first.y, grid_.rows); row <= within(last.y, grid_.rows); ++row) {
    for (std::size_t column = within(first.x, grid_.columns); column <= within(last.x, grid_.columns); ++column)
      widen(heights_(column, row), heights);
  }
}

void CoarseHeights::grow() {
  const Array2D<Interval> before = heights_;
  for (std::size_t row = 0; row < grid_.rows; ++row) {
    for (std::size_t column = 0; column < grid_.columns; ++column) {
      for (std::size_t y = row - std::min<std::size_t>(row, 1); y <= std::min(row + 1, grid_.rows - 1); ++y) {
        for (std::size_t x = column - std::min<std::size_t>(column, 1); x <= std::min(column + 1, grid_.columns - 1);
             ++x) {
          widen(heights_(column, row), before(x, y));
        }
      }
    }
  }
}

}  // namespace sigmascape::trace
