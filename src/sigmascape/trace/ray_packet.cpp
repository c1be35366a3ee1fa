#include "sigmascape/trace/ray_packet.h"

#include <algorithm>

#include "sigmascape/base/vector_targets.h"

namespace sigmascape::trace {

RayPacket::RayPacket() : query{} {
  std::ranges::fill(query.ray.mask, ~0U);
}

void RayPacket::forget_hits() {
  std::ranges::fill(query.hit.geomID, RTC_INVALID_GEOMETRY_ID);
  std::ranges::fill(query.hit.instID[0], RTC_INVALID_GEOMETRY_ID);
}

void RayPacket::forget_hit(std::size_t lane) {
  query.hit.geomID[lane] = RTC_INVALID_GEOMETRY_ID;
  query.hit.instID[0][lane] = RTC_INVALID_GEOMETRY_ID;
}

void RayPacket::set_lengths(float length_m) {
  std::ranges::fill(query.ray.tfar, length_m);
}

SIGMASCAPE_VECTOR_TARGETS [[gnu::flatten]] void set_lengths_to(const LevelPlane& plane, RayPacket& packet) {
  RTCRay16& ray = packet.query.ray;
  for (std::size_t i = 0; i < lane_count; ++i) {
    ray.tfar[i] =
        plane.distance_m({ray.org_x[i], ray.org_y[i], ray.org_z[i]}, {ray.dir_x[i], ray.dir_y[i], ray.dir_z[i]});
  }
}

SIGMASCAPE_VECTOR_TARGETS [[gnu::flatten]] void bring_into_world(const RayPacket& packet,
                                                                 const PlacementLanes& placements, MetLanes& met) {
  const RTCRay16& ray = packet.query.ray;
  const RTCHit16& hit = packet.query.hit;
  for (std::size_t i = 0; i < lane_count; ++i) {
    const Vec3f direction{ray.dir_x[i], ray.dir_y[i], ray.dir_z[i]};
    met.position.set(i, Vec3f{ray.org_x[i], ray.org_y[i], ray.org_z[i]} + direction * ray.tfar[i]);
    const FacePlane face = placements[i].in_world(
        {.normal = {hit.Ng_x[i], hit.Ng_y[i], hit.Ng_z[i]}, .inverse_area_per_m2 = placements.inverse_area_per_m2[i]});
    met.inverse_area_per_m2[i] = face.inverse_area_per_m2;
    met.norm[i] = length(face.normal);
    met.normal.set(i, face.normal * ((dot(face.normal, direction) < 0.0F ? 1.0F : -1.0F) / met.norm[i]));
  }
}

}  // namespace sigmascape::trace
