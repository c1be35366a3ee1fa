#pragma once

#include "sigmascape/radar/azimuth_span.h"
#include "sigmascape/radar/ground_grid.h"
#include "sigmascape/render/reflecting_ground.h"
#include "sigmascape/render/sight_grid.h"

namespace sigmascape::render {

/// What of every place of an area a radar sees, reckoned once along azimuths for places in any order.
class SightMap {
 public:
  /// Azimuths and steps are `step_m` apart at the far end of the area.
  SightMap(const ReflectingGround& ground, Vec3d radar_position, const radar::Rectangle& terrain_extent,
           const radar::Rectangle& area, double step_m, unsigned threads);

  /// That of the nearest place that was reckoned.
  [[nodiscard]] terrain::Sight at(Vec2d point) const;

 private:
  Vec2d origin_;
  radar::AzimuthSpan azimuths_;
  double azimuth_step_rad_ = 0.0, near_m_ = 0.0, step_m_ = 1.0;
  SightGrid sights_;  // lines are azimuths
};

}  // namespace sigmascape::render
