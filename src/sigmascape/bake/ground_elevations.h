#pragma once

#include <vector>

#include "sigmascape/scene/scene.h"

namespace sigmascape::bake {

/// What is read between the elevations of the ground is off by no more than this, where there is more than the floor.
inline constexpr double ground_tolerance_db = 1.0, ground_floor_db = -70.0;

/// The elevations at which the ground's own σ0 is to be kept at these frequencies, in radians, ascending from 0.2° to
/// 89°: so many that what atlas::weights_for reads between them is within `ground_tolerance_db` of the level ground's
/// σ0 for every material that the ground is made of, each polarization for itself. Two are enough where γ is constant;
/// the steep lobe of a smooth surface takes some twenty, and one smoother than α = 0.05, within degrees of the
/// vertical, is off by more.
[[nodiscard]] std::vector<double> ground_elevations_rad(const scene::Scene& scene,
                                                        const std::vector<double>& frequencies_hz);

}  // namespace sigmascape::bake
