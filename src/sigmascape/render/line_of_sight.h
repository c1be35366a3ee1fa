#pragma once

#include "sigmascape/base/vec.h"
#include "sigmascape/radar/curved_earth.h"
#include "sigmascape/terrain/height_field.h"

namespace sigmascape::render {

/// Whether the bare terrain lets the radar see a point, by a march along the straight line between them in steps of the
/// terrain's spacing, and whether the round Earth does beside it (radar/sea_horizon.h). `lowest_m` and `highest_m` are
/// the terrain's own; above the highest the march ends.
[[nodiscard]] bool line_of_sight(const terrain::HeightField& terrain, double lowest_m, double highest_m, Vec3d radar,
                                 Vec3d point, const radar::CurvedEarth& earth = radar::CurvedEarth::flat());

}  // namespace sigmascape::render
