#pragma once

#include "sigmascape/atlas/store.h"
#include "sigmascape/scene/scene.h"

namespace sigmascape::bake {

/// Fills in what the store does not have yet of the ground apart from what stands on it: its σ0 by itself, in closed
/// form from the ground's materials, and the obstacles. See atlas::GroundLayers.
void bake_ground(const scene::Scene& scene, const atlas::Store& store);

}  // namespace sigmascape::bake
