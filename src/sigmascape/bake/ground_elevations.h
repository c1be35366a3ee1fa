#pragma once

#include <vector>

#include "sigmascape/atlas/aspect_grid.h"
#include "sigmascape/scene/scene.h"

namespace sigmascape::bake {

/// What is read between the elevations of the ground is off by no more than this, where there is more than the floor,
/// and by no more than the other at those that looks were baked at.
inline constexpr double ground_tolerance_db = 0.2, at_looks_tolerance_db = 0.02, ground_floor_db = -70.0;

/// The elevations at which the ground's own σ0 is to be kept beside these looks, in radians, ascending from 0.2° to
/// 89°: so many that what atlas::weights_for reads between them is within those tolerances of the level ground's σ0
/// for every material that the ground is made of, at each frequency and each polarization for itself. Two are enough
/// where γ is constant; the steep lobe of a smooth surface takes some fifty.
///
/// Names of files tell tenths of degrees. What changes within so little is read as off by more: surfaces smoother than
/// α = 0.05, within degrees of the vertical, and models of low angles below half a degree.
/// docs/decisions/0156-the-ground-as-it-is-at-the-looks.md.
[[nodiscard]] std::vector<double> ground_elevations_rad(const scene::Scene& scene, const atlas::AspectGrid& looks);

}  // namespace sigmascape::bake
