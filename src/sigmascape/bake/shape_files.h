#pragma once

#include <vector>

#include "sigmascape/atlas/store.h"
#include "sigmascape/bake/claims.h"
#include "sigmascape/base/progress.h"
#include "sigmascape/scene/scene.h"

namespace sigmascape::bake {

/// Makes what an atlas keeps of the scene's own shape, whatever the looks, where it is not there or not whole: heights
/// (`terrain.tif`), their tiles (`terrain/`) and, where buildings are kept apart, walls and roofs (`buildings.glb`).
/// One process at a time, with the claim to the terrain; tells `progress` while it waits for another.
///
/// Returns the faults that were mended, as well of files that there were not. Tiles that `sigmascape atlas terrain`
/// made, from a raster, stay as they are. Tiles are read where `scrutiny` asks for their content.
std::vector<atlas::StoreFault> write_shape_files(const scene::Scene& scene, const atlas::Store& store,
                                                 bool with_buildings, const Claims& claims, atlas::Scrutiny scrutiny,
                                                 ProgressListener& progress);

}  // namespace sigmascape::bake
