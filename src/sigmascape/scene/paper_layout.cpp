#include "sigmascape/scene/paper_layout.h"

#include <algorithm>

#include "sigmascape/base/hash.h"

namespace sigmascape::scene {
namespace {

/// A curve through points given in sides of the map, each moved a little by the seed.
SmoothLine curve(std::vector<Vec2d> points, double side_m, double wander, std::uint64_t key, double step_m) {
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vec2d move{unit_float(hashed(key, i, 0)) - 0.5, unit_float(hashed(key, i, 1)) - 0.5};
    points[i] = (points[i] + move * wander) * side_m;
  }
  return {points, step_m};
}

}  // namespace

ConvexPolygon PaperLayout::square() const {
  const double half = size.side_m / 2.0;
  return {{-half, -half}, {half, -half}, {half, half}, {-half, half}};
}

PaperLayout paper_layout(const PaperSceneOptions& options) {
  PaperLayout layout;
  layout.size = paper_scene_size(options.scale);
  layout.seed = mixed(options.seed);
  const double side = layout.size.side_m;
  const auto key = [&](unsigned n) { return hashed(layout.seed, 100 + n); };

  layout.river = curve({{-0.44, 0.58},
                        {-0.30, 0.43},
                        {-0.34, 0.28},
                        {-0.22, 0.15},
                        {-0.21, 0.01},
                        {-0.29, -0.12},
                        {-0.20, -0.25},
                        {-0.09, -0.34},
                        {-0.13, -0.45},
                        {-0.05, -0.58}},
                       side, 0.05, key(0), 12.0);
  layout.river_half_width_m = std::clamp(0.011 * side, 9.0, 24.0);
  layout.lakes = {{layout.river.nearest_to(Vec2d{-0.34, 0.29} * side).point + Vec2d{-0.03, 0.0} * side, 0.065 * side},
                  {Vec2d{0.36, -0.17} * side, 0.024 * side}};
  layout.highway =
      curve({{-0.56, -0.31}, {-0.30, -0.34}, {-0.02, -0.29}, {0.28, -0.35}, {0.56, -0.30}}, side, 0.03, key(1), 8.0);

  const Vec2d centre{0.05 + 0.04 * (unit_float(key(2)) - 0.5), 0.02 + 0.04 * (unit_float(key(3)) - 0.5)};
  layout.town_centre = centre * side;
  layout.town_radius_m = 0.28 * side;
  const Vec2d junction = layout.highway.nearest_to(Vec2d{0.09, -0.30} * side).point * (1.0 / side);
  layout.main_roads.push_back(
      curve({junction, {0.07, -0.16}, centre, {0.13, 0.24}, {0.15, 0.40}, {0.10, 0.56}}, side, 0.0, key(4), 8.0));
  layout.main_roads.push_back(
      curve({{-0.56, 0.09}, {-0.38, 0.04}, {-0.20, -0.03}, centre, {0.26, 0.08}, {0.40, 0.05}, {0.56, 0.09}}, side, 0.0,
            key(5), 8.0));
  return layout;
}

}  // namespace sigmascape::scene
