#pragma once

#include <optional>

#include "sigmascape/radar/doppler.h"
#include "sigmascape/radar/track.h"

namespace sigmascape::receiver {

/// A target at the moment at which a moving platform comes nearer to it at some speed.
struct TargetPassage {
  double time_s = 0.0;
  radar::Motion target = {};
  Vec3d away = {};                  ///< from the platform to the target
  double range_m = 0.0;             ///< its length
  double relative_speed_mps = 0.0;  ///< of the platform past the target
};

/// When the distance shrinks by `closing_mps`, at a Doppler of 2/λ times as much. On straight ways
///
///     t = (A·ŵ − d tan φ_w)/|w|,   sin φ_w = closing/|w|                    docs/physics/doppler.md, Eq. (6a)
///
/// with w the platform's velocity past the target, A the way from one to the other at time zero and d their least
/// distance. Legs of a track are gone through, from that at `near_s` on, until the moment lies on the leg that it was
/// reckoned for. Nothing when the two never close in so fast, do not move past one another, or meet. `platform`: at
/// time zero.
[[nodiscard]] std::optional<TargetPassage> target_passage(const radar::Track& target, const radar::Motion& platform,
                                                          double closing_mps, double near_s);

}  // namespace sigmascape::receiver
