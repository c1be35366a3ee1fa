#pragma once

#include "sigmascape/base/vec.h"
#include "sigmascape/radar/curved_earth.h"
#include "sigmascape/terrain/height_field.h"

namespace sigmascape::render {

/// Whether the bare terrain lets the radar see a point, by a march along the straight line between them in steps of the
/// terrain's spacing. `highest_m` is the terrain's highest point, above which the march ends.
[[nodiscard]] bool line_of_sight(const terrain::HeightField& terrain, double highest_m, Vec3d radar, Vec3d point,
                                 const radar::CurvedEarth& earth = radar::CurvedEarth::flat());

}  // namespace sigmascape::render
