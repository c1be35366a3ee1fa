#pragma once

#include <cstddef>
#include <embree3/rtcore.h>

#include "sigmascape/base/lanes.h"
#include "sigmascape/trace/level_plane.h"
#include "sigmascape/trace/placement.h"
#include "sigmascape/trace/ray.h"

namespace sigmascape::trace {

/// Sixteen rays on their way to Embree and back.
struct RayPacket {
  RTCRayHit16 query;
  alignas(64) int valid[lane_count];

  /// Sets what all rays have in common and never changes.
  RayPacket();
  /// Of the next question, which has so many.
  template <typename RayAt>
  void set_rays(std::size_t lanes, const RayAt& ray_at) {
    for (std::size_t lane = 0; lane < lane_count; ++lane) {
      valid[lane] = lane < lanes ? -1 : 0;
      set_ray(lane, ray_at(lane < lanes ? lane : lanes - 1));
    }
    forget_hits();
  }
  void set_ray(std::size_t lane, const Ray& ray) {
    query.ray.org_x[lane] = ray.origin.x;
    query.ray.org_y[lane] = ray.origin.y;
    query.ray.org_z[lane] = ray.origin.z;
    query.ray.dir_x[lane] = ray.direction.x;
    query.ray.dir_y[lane] = ray.direction.y;
    query.ray.dir_z[lane] = ray.direction.z;
  }
  [[nodiscard]] Ray ray(std::size_t lane) const {
    return {{query.ray.org_x[lane], query.ray.org_y[lane], query.ray.org_z[lane]},
            {query.ray.dir_x[lane], query.ray.dir_y[lane], query.ray.dir_z[lane]}};
  }
  [[nodiscard]] bool has_met(std::size_t lane) const { return query.hit.geomID[lane] != RTC_INVALID_GEOMETRY_ID; }
  void forget_hits();
  void forget_hit(std::size_t lane);
  void set_lengths(float length_m);
};

/// Rays go to the plane at most where they meet it, and else without end.
void set_lengths_to(const LevelPlane& plane, RayPacket& packet);

/// How the instances that sixteen rays have met stand in the world, and the areas of their faces before that.
struct PlacementLanes {
  FloatLanes cos_yaw, sin_yaw, inverse_volume_scale;
  VectorLanes inverse_scale;
  FloatLanes inverse_area_per_m2;

  [[nodiscard]] Placement operator[](std::size_t i) const {
    return {cos_yaw[i], sin_yaw[i], inverse_scale[i], inverse_volume_scale[i]};
  }
  void set(std::size_t i, const Placement& placement) {
    cos_yaw[i] = placement.cos_yaw;
    sin_yaw[i] = placement.sin_yaw;
    inverse_scale.set(i, placement.inverse_scale);
    inverse_volume_scale[i] = placement.inverse_volume_scale;
  }
};

/// The same faces in the world.
struct MetLanes {
  VectorLanes position, normal;
  FloatLanes norm;  ///< of the normal before it was made one: 0 of a face that has none
  FloatLanes inverse_area_per_m2;
};

/// Lanes that have met nothing get answers of no meaning.
void bring_into_world(const RayPacket& packet, const PlacementLanes& placements, MetLanes& met);

}  // namespace sigmascape::trace
