#include "sigmascape/trace/multibounce_reach.h"

#include <algorithm>
#include <cmath>

#include "sigmascape/trace/late_by.h"

namespace sigmascape::trace {
namespace {

/// Between slopes of bare ground, and among the lowest things.
constexpr double least_m = 32.0;
/// Of the distance before. Ends that lie apart across the line of sight are apart along it, too.
constexpr double part_beside = 0.5;

double lowest_sine_of_grazing(const Viewpoint& viewpoint, const radar::Rectangle& target) {
  double sine = 1.0;
  for (const Vec3d corner : {Vec3d{target.west_m, target.south_m, 0.0},
                             {target.east_m, target.south_m, 0.0},
                             {target.west_m, target.north_m, 0.0},
                             {target.east_m, target.north_m, 0.0}}) {
    sine = std::min(sine, viewpoint.direction_from(corner).z);
  }
  return sine;
}

}  // namespace

double late_by_m(double tallest_m, const Viewpoint& viewpoint, const radar::Rectangle& target) {
  return std::clamp(tallest_m / lowest_sine_of_grazing(viewpoint, target), least_m, farthest_bounce_m);
}

double farthest_beginning_m(double late_m) {
  return std::hypot(late_m, part_beside * late_m);
}

MultibounceReach multibounce_reach(double tallest_m, const radar::Rectangle& occupied, const Viewpoint& viewpoint,
                                   const radar::Rectangle& target) {
  const double before_m = late_by_m(tallest_m, viewpoint, target);
  return {.before_m = before_m, .beside_m = part_beside * before_m, .within = occupied};
}

MultibounceReach multibounce_reach(const scene::Scene& scene, const Viewpoint& viewpoint,
                                   const radar::Rectangle& target) {
  return multibounce_reach(scene::tallest_object_m(scene), scene::occupied_extent(scene), viewpoint, target);
}

}  // namespace sigmascape::trace
