#pragma once

#include "sigmascape/base/vec.h"
#include "sigmascape/radar/echo.h"
#include "sigmascape/radar/look.h"
#include "sigmascape/terrain/height_field.h"

namespace sigmascape::bake {

/// Where echoes of an infinitely distant radar stand for one who knows the ground alone: on the ground, at their range
/// and cross position.
///
/// Range ρ is reckoned from the plane through the local origin that faces the radar, so that the place a·t + b·c (a
/// towards the radar, b to its right) is where
///
///     t cos ψ + h(a·t + b·c) sin ψ = −ρ                               docs/physics/estimator.md, Eq. (5)
///
/// h the height of the ground. What is tall lies over towards the radar until its range meets the slope. Where ground
/// steeper than the line of sight lies over itself there are several such places, one of which is taken: a radar cannot
/// tell them apart.
class EchoLanding {
 public:
  /// On the level ground h = 0.
  explicit EchoLanding(const radar::Aspect& aspect);
  /// On relief between two heights, which must outlive this.
  EchoLanding(const radar::Aspect& aspect, const terrain::HeightField& relief, double lowest_m, double highest_m);

  [[nodiscard]] Vec2d place_of(const radar::Echo& echo) const;

 private:
  [[nodiscard]] double distance_on_relief(double range_m, Vec2d across) const;

  Vec2d towards_radar_, right_;
  double sine_, cosine_;
  const terrain::HeightField* relief_ = nullptr;
  double lowest_m_ = 0.0, highest_m_ = 0.0;
};

}  // namespace sigmascape::bake
