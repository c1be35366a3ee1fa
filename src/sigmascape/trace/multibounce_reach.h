#pragma once

#include <limits>

#include "sigmascape/radar/ground_grid.h"
#include "sigmascape/scene/scene.h"
#include "sigmascape/trace/viewpoint.h"

namespace sigmascape::trace {

/// Paths of several bounces that go farther than this are left out where that saves something: in San Francisco 0.3 %
/// of what several bounces return begins so far away (docs/physics/estimator.md).
inline constexpr double farthest_bounce_m = 1024.0;

/// How far from where their echoes land paths of several bounces may begin.
///
/// The way between its ends makes an echo late: it lands behind both ends as the radar sees it, never before them.
/// Across the line of sight it lands midway. docs/physics/estimator.md, Eqs. (12), (13).
struct MultibounceReach {
  double before_m = 0.0;  ///< towards the radar
  double beside_m = 0.0;
  radar::Rectangle within = {-infinite, -infinite, infinite, infinite};  ///< nothing begins outside, but in the target

 private:
  static constexpr double infinite = std::numeric_limits<double>::infinity();
};

/// How far from a target paths may begin that are late by so much, whatever the azimuth: along the diagonal of what
/// lies before and what lies beside.
[[nodiscard]] double farthest_beginning_m(double late_m);

/// The reach for echoes that land in `target`.
///
/// What comes in over the tallest thing of height H and keeps its slope, as between upright mirrors, has met the ground
/// after H cot ψ and is above everything after as much again; half that way, H / sin ψ, is what its echo is late by,
/// and it lands by that over cos ψ behind. Surfaces that scatter send more steeply and less steeply as well: so it is a
/// length to go by, not a bound.
[[nodiscard]] MultibounceReach multibounce_reach(const scene::Scene& scene, const Viewpoint& viewpoint,
                                                 const radar::Rectangle& target);
/// The same over a scene of that tallest thing that occupies that extent, for who asks often.
[[nodiscard]] MultibounceReach multibounce_reach(double tallest_m, const radar::Rectangle& occupied,
                                                 const Viewpoint& viewpoint, const radar::Rectangle& target);

}  // namespace sigmascape::trace
