#include "sigmascape/simulate/ground_met.h"

namespace sigmascape::simulate {
namespace {

constexpr double highest_twist_m = 100.0;

}  // namespace

Vec3d ground_met_at(const trace::SceneGeometry& geometry, Vec3d place) {
  // Asked from ever higher, lest what stands there be met first.
  for (double above_m = ray_lift_m; above_m < highest_twist_m; above_m *= 2.0) {
    const Vec3d from = place + Vec3d{0.0, 0.0, above_m};
    trace::SurfaceHit hit;
    if (geometry.intersect((from - geometry.origin()).to<float>(), {0.0F, 0.0F, -1.0F}, hit) && hit.is_ground)
      return {place.x, place.y, static_cast<double>(hit.position.z) + geometry.origin().z};
  }
  return place;
}

}  // namespace sigmascape::simulate
