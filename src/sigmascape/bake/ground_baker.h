#pragma once

#include <vector>

#include "sigmascape/atlas/store.h"
#include "sigmascape/bake/shard.h"
#include "sigmascape/base/progress.h"
#include "sigmascape/scene/scene.h"

namespace sigmascape::bake {

/// Fills in what the store does not have yet of the ground apart from what stands on it: its σ0 by itself, in closed
/// form from the ground's materials, and the obstacles, of the patches that fall to the share (JobShare::has_patch).
/// Then makes what has become possible of the levels above them. See atlas::GroundLayers. Tells `progress`, if it is
/// given, of the "patches" of the work "ground", then of the "layers" of the work "pyramid": σ0 from one look, or
/// obstacles. Returns what was there, damaged, and was made anew; files are relative to the atlas.
std::vector<atlas::StoreFault> bake_ground(const scene::Scene& scene, const atlas::Store& store,
                                           const Shard& shard = {}, atlas::Scrutiny scrutiny = atlas::Scrutiny::Size,
                                           ProgressListener* progress = nullptr);

}  // namespace sigmascape::bake
