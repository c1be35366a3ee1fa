#pragma once

#include "sigmascape/base/vec.h"
#include "sigmascape/radar/look.h"
#include "sigmascape/radar/obstacle.h"
#include "sigmascape/terrain/height_field.h"

namespace sigmascape::bake {

/// What bare terrain leaves to be seen from an infinitely distant radar: what terrain::Sight::objects is to one nearby.
class TerrainHorizon {
 public:
  /// `relief` must outlive this. Terrain is looked at every `step_m`.
  TerrainHorizon(const radar::Aspect& aspect, const terrain::HeightField& relief, double step_m);

  /// The part of an obstacle's height, from 0 to 1, that rises above the terrain before it; of what has no height,
  /// whether it is seen.
  [[nodiscard]] double part_seen(Vec2d place, const radar::Obstacle& obstacle) const;

 private:
  const terrain::HeightField& relief_;
  Vec2d step_;
  double fall_m_;  // of the line of sight, a step
  double highest_m_;
};

}  // namespace sigmascape::bake
