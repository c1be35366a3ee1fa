#pragma once

#include <limits>

#include "sigmascape/bake/highest_ground.h"
#include "sigmascape/base/vec.h"
#include "sigmascape/radar/look.h"
#include "sigmascape/terrain/height_field.h"

namespace sigmascape::bake {

/// What bare terrain hides from an infinitely distant radar: what terrain::Sight::hidden_m is to one nearby.
class TerrainHorizon {
 public:
  /// Both must outlive this; `highest` is that of `relief`. Terrain is looked at every `step_m`, but for what is too
  /// low to hide anything more.
  TerrainHorizon(const radar::Aspect& aspect, const terrain::HeightField& relief, const HighestGround& highest,
                 double step_m);

  /// The height above the ground up to which the terrain before a place hides what stands there. Beyond the end of the
  /// terrain there is none.
  [[nodiscard]] double hidden_m(Vec2d place) const { return hidden_m(place, std::numeric_limits<double>::infinity()); }
  /// The same, or some height from `enough_m` on where it is no less: what is no taller is hidden altogether, and
  /// nobody need look farther.
  [[nodiscard]] double hidden_m(Vec2d place, double enough_m) const;

 private:
  /// From a point on to the first beyond a square that it is in.
  [[nodiscard]] double steps_through(const radar::Rectangle& square, Vec2d point) const;

  const terrain::HeightField& relief_;
  const HighestGround& highest_;
  Vec2d step_;
  double fall_m_;  // of the line of sight, a step
  double highest_m_;
  radar::Rectangle extent_;  // beyond which nothing hides
};

}  // namespace sigmascape::bake
