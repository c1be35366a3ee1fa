#pragma once

#include "sigmascape/atlas/store.h"
#include "sigmascape/bake/shard.h"
#include "sigmascape/scene/scene.h"

namespace sigmascape::bake {

/// Fills in what the store does not have yet of the ground apart from what stands on it: its σ0 by itself, in closed
/// form from the ground's materials, and the obstacles, of the patches that fall to the share: patches are dealt as
/// jobs are. Then makes what has become possible of the levels above them. See atlas::GroundLayers.
void bake_ground(const scene::Scene& scene, const atlas::Store& store, const Shard& shard = {},
                 atlas::Scrutiny scrutiny = atlas::Scrutiny::Size);

}  // namespace sigmascape::bake
