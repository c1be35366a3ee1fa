#pragma once

#include "sigmascape/radar/ground_grid.h"
#include "sigmascape/radar/radar.h"

namespace sigmascape::simulate {

/// The ground that answers in the cells of a real-beam map of `area`: the area, and what of `extent` lies beside it
/// within four range resolutions, or so near that a beam aimed at the edge of the area takes no more than 1 % of its
/// power from beyond: the two-way half-power width of a Gaussian beam, more where there are lobes beside the axis.
/// A range resolution reaches over the ground as over level ground as low as any, where it reaches farthest.
[[nodiscard]] radar::Rectangle answering_ground(const radar::Radar& radar, const radar::Rectangle& area,
                                                const radar::Rectangle& extent, double lowest_ground_m);

}  // namespace sigmascape::simulate
