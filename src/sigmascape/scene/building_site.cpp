#include "sigmascape/scene/building_site.h"

#include <algorithm>

namespace sigmascape::scene {
namespace {

constexpr double margin_m = 0.7;

bool contains(const ConvexPolygon& polygon, Vec2d p) {
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    if (cross(polygon[(i + 1) % polygon.size()] - polygon[i], p - polygon[i]) < 0.0) return false;
  }
  return true;
}

}  // namespace

bool BuildingSite::put_up(const RoofedBuilding& shape, const ConvexPolygon& lot) {
  if (is_done()) return false;
  const ConvexPolygon footprint =
      oriented_rectangle(shape.centre, shape.along, shape.length_m + 2.0 * margin_m, shape.depth_m + 2.0 * margin_m);
  if (!std::ranges::all_of(footprint, [&](Vec2d corner) { return contains(lot, corner); })) return false;
  if (!ground_.is_free(footprint, {GroundClass::Grass, GroundClass::Concrete})) return false;
  ground_.mark_built(footprint);
  buildings_.push_back(shape);
  return true;
}

}  // namespace sigmascape::scene
