#pragma once

#include "sigmascape/radar/ground_grid.h"
#include "sigmascape/radar/radar.h"

namespace sigmascape::simulate {

/// The ground that answers in the cells of a real-beam map of `area`: the area, and what of `extent` lies within a
/// two-way half-power width of the beam, or four range resolutions, beside it.
///
/// A beam that is aimed at the edge of the area has half of its footprint beyond it. What lies farther away than this
/// is 0.9 % of all the ground that a Gaussian beam takes in there.
[[nodiscard]] radar::Rectangle answering_ground(const radar::Radar& radar, const radar::Rectangle& area,
                                                const radar::Rectangle& extent);

}  // namespace sigmascape::simulate
