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

/// Of level ground at height zero where there is no terrain, which from infinitely far away is seen as any other.
double lowest_sine_of_grazing(const Viewpoint& viewpoint, const radar::Rectangle& target,
                              const terrain::HeightField* terrain) {
  double sine = 1.0;
  for (const Vec2d corner : radar::corners_of(target)) {
    const double height_m = terrain != nullptr ? terrain->height_at(corner) : 0.0;
    sine = std::min(sine, viewpoint.direction_from({corner.x, corner.y, height_m}).z);
  }
  return sine;
}

/// What comes late by so much of slant range lands by that over cos ψ behind.
double late_when_seen_under(double sine_of_grazing, double tallest_m) {
  // A radar that stands lower than some of the ground sees it under no angle, and from above all lands far behind.
  const double cosine = std::sqrt(std::max(0.0, 1.0 - sine_of_grazing * sine_of_grazing));
  if (sine_of_grazing <= 0.0 || tallest_m > farthest_bounce_m * sine_of_grazing * cosine) return farthest_bounce_m;
  return std::max(least_m, tallest_m / (sine_of_grazing * cosine));
}

}  // namespace

double late_by_m(double tallest_m, const Viewpoint& viewpoint, const radar::Rectangle& target) {
  return late_when_seen_under(lowest_sine_of_grazing(viewpoint, target, nullptr), tallest_m);
}

double late_by_m(double tallest_m, const Viewpoint& viewpoint, const radar::Rectangle& target,
                 const terrain::HeightField& terrain) {
  return late_when_seen_under(lowest_sine_of_grazing(viewpoint, target, &terrain), tallest_m);
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
