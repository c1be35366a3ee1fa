#pragma once

#include <cstdint>

#include "sigmascape/base/lanes.h"
#include "sigmascape/trace/viewpoint.h"

namespace sigmascape::trace {

/// From where to where rays go that are aimed at cells of a launch lattice.
struct LaunchSpace {
  double cell_m = 1.0;
  double plane_height_m = 0.0;  ///< of what is aimed at
  double top_height_m = 0.0;    ///< at which rays start
  Vec3d origin;                 ///< that rays are relative to
};

/// Where sixteen rays are aimed.
struct AimLanes {
  alignas(64) std::int32_t i[lane_count]{};
  alignas(64) std::int32_t j[lane_count]{};
  PairLanes within_cell;
};

struct LaunchedLanes {
  VectorLanes start, direction;
  alignas(64) double beam[lane_count];  ///< Viewpoint::beam_of a whole cell
};

void aim_rays(const Viewpoint& viewpoint, const LaunchSpace& space, const AimLanes& aims, LaunchedLanes& launched);

}  // namespace sigmascape::trace
