#pragma once

#include "sigmascape/atlas/store.h"
#include "sigmascape/radar/radar.h"
#include "sigmascape/render/level_of_detail.h"
#include "sigmascape/scene/scene.h"

namespace sigmascape::simulate {

/// What render::choose_detail is to be asked for a map of `grid` by a placed radar. Across the line of sight a real
/// beam tells apart what its width covers, a coherent mode what it is planned to (radar::coherent_plan). Without a
/// store the texels are the map's cells. Throws Error as coherent_plan does.
[[nodiscard]] render::DetailQuestion map_question(const scene::Scene& scene, const radar::Radar& radar,
                                                  const radar::GroundGrid& grid, const atlas::Store* store);

}  // namespace sigmascape::simulate
