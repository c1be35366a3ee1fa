#include "sigmascape/trace/multibounce_reach.h"

#include <algorithm>
#include <cmath>

#include "sigmascape/radar/rectangle_distances.h"
#include "sigmascape/trace/late_by.h"

namespace sigmascape::trace {
namespace {

/// Between slopes of bare ground, and among the lowest things.
constexpr double least_m = 32.0;
/// Of the distance before. Ends that lie apart across the line of sight are apart along it, too.
constexpr double part_beside = 0.5;

/// Of what lands at a place.
double late_at(Vec3d place, double tallest_m, const Viewpoint& viewpoint) {
  const double sine_of_grazing = viewpoint.direction_from(place).z;
  // A radar that stands lower than some of the ground sees it under no angle.
  if (sine_of_grazing <= 0.0) return farthest_bounce_m;
  return std::clamp(viewpoint.nearer_before_m(place, tallest_m / sine_of_grazing), least_m, farthest_bounce_m);
}

/// The most of the corners and of the place nearest to the radar. On level ground at height zero where there is no
/// terrain, which from infinitely far away is seen as any other.
double late_over(const radar::Rectangle& target, double tallest_m, const Viewpoint& viewpoint,
                 const terrain::HeightField* terrain) {
  double late_m = 0.0;
  const auto take_in = [&](Vec2d place) {
    const double height_m = terrain != nullptr ? terrain->height_at(place) : 0.0;
    late_m = std::max(late_m, late_at({place.x, place.y, height_m}, tallest_m, viewpoint));
  };
  std::ranges::for_each(radar::corners_of(target), take_in);
  take_in(viewpoint.nearest_point(target));
  return late_m;
}

}  // namespace

double late_by_m(double tallest_m, const Viewpoint& viewpoint, const radar::Rectangle& target) {
  return late_over(target, tallest_m, viewpoint, nullptr);
}

double late_by_m(double tallest_m, const Viewpoint& viewpoint, const radar::Rectangle& target,
                 const terrain::HeightField& terrain) {
  return late_over(target, tallest_m, viewpoint, &terrain);
}

double farthest_beginning_m(double late_m) {
  return std::hypot(late_m, part_beside * late_m);
}

MultibounceReach reach_of_late(double late_m, const radar::Rectangle& occupied) {
  return {.before_m = late_m, .beside_m = part_beside * late_m, .within = occupied};
}

MultibounceReach multibounce_reach(double tallest_m, const radar::Rectangle& occupied, const Viewpoint& viewpoint,
                                   const radar::Rectangle& target) {
  return reach_of_late(late_by_m(tallest_m, viewpoint, target), occupied);
}

MultibounceReach multibounce_reach(const scene::Scene& scene, const Viewpoint& viewpoint,
                                   const radar::Rectangle& target) {
  return reach_of_late(late_by_m(scene::tallest_object_m(scene), viewpoint, target, scene.terrain),
                       scene::occupied_extent(scene));
}

}  // namespace sigmascape::trace
