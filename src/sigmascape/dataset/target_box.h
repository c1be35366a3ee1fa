#pragma once

#include <cstddef>
#include <optional>

#include "sigmascape/product/coco.h"
#include "sigmascape/radar/ground_grid.h"
#include "sigmascape/radar/radar.h"
#include "sigmascape/terrain/height_field.h"

namespace sigmascape::dataset {

/// The ground on which a map shows a point target: a stretch along the target's azimuth, in horizontal distances from
/// the radar.
struct ShownStretch {
  double near_m = 0.0, far_m = 0.0;
};

/// A map lays an echo on all ground of its azimuth and range. Of the stretches whose slant range is the target's to
/// within half the radar's resolution, which is its half-power response, this is the one nearest the target: where
/// ground is laid over there are several, and what stands high above a crest shows in front of it. Nothing when no
/// ground is as near as the target. Ground is looked at every quarter of a cell or of the terrain's spacing.
[[nodiscard]] std::optional<ShownStretch> shown_stretch(Vec3d target, const radar::Radar& radar,
                                                        const terrain::HeightField& terrain, double cell_m);

/// The box, sides along the map's and cut to it, about where the map shows a target's response between half-power
/// points, and `size_m` more for the target itself. Without width and height when that is not on the map.
[[nodiscard]] product::TargetBox target_box(Vec3d target, double size_m, const radar::Radar& radar,
                                            const terrain::HeightField& terrain, const radar::GroundGrid& grid);

}  // namespace sigmascape::dataset
