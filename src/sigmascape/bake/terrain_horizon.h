#pragma once

#include <limits>

#include "sigmascape/base/vec.h"
#include "sigmascape/radar/look.h"
#include "sigmascape/terrain/height_field.h"

namespace sigmascape::bake {

/// What bare terrain hides from an infinitely distant radar: what terrain::Sight::hidden_m is to one nearby.
class TerrainHorizon {
 public:
  /// `relief` must outlive this; none of it is higher than `highest_m`. Terrain is looked at every `step_m`.
  TerrainHorizon(const radar::Aspect& aspect, const terrain::HeightField& relief, double highest_m, double step_m);

  /// The height above the ground up to which the terrain before a place hides what stands there. Beyond the end of the
  /// terrain there is none.
  [[nodiscard]] double hidden_m(Vec2d place) const { return hidden_m(place, std::numeric_limits<double>::infinity()); }
  /// The same, or some height from `enough_m` on where it is no less: what is no taller is hidden altogether, and
  /// nobody need look farther.
  [[nodiscard]] double hidden_m(Vec2d place, double enough_m) const;

 private:
  const terrain::HeightField& relief_;
  Vec2d step_;
  double fall_m_;  // of the line of sight, a step
  double highest_m_;
  radar::Rectangle extent_;  // beyond which nothing hides
};

}  // namespace sigmascape::bake
