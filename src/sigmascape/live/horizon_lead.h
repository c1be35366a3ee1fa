#pragma once

#include <cstddef>

#include "sigmascape/base/vec.h"
#include "sigmascape/live/horizon_grid.h"
#include "sigmascape/live/occluders.h"
#include "sigmascape/terrain/terrain_pyramid.h"

namespace sigmascape::live {

/// The steps of a sweep before the map's first node: from the nearest ground that may hide any of the map's.
struct LeadSteps {
  double from_m = 0.0, step_m = 1.0;
  std::size_t count = 0;
};
[[nodiscard]] LeadSteps lead_of(const HorizonGrid& grid, Vec3d radar, const Occluders& occluders);
/// The same of all that may hide the map's ground, known by its bounds alone.
[[nodiscard]] LeadSteps lead_of(const HorizonGrid& grid, Vec3d radar, const terrain::HeightBounds& bounds);

}  // namespace sigmascape::live
