#pragma once

#include <string>
#include <vector>

#include "sigmascape/radar/coherent_plan.h"
#include "sigmascape/radar/ground_grid.h"
#include "sigmascape/radar/radar.h"

namespace sigmascape::radar {

/// What a radar engineer would object to before this plan maps an area at this height, one sentence each: ground in the
/// blind wedge, ground on both sides of the track, a resolution across range that is wider than the area, an interval
/// in which the line of sight turns so far that pulses would resolve 5 % less than the plan says, looks of less than
/// four pulses, Doppler that folds or goes round the end of the image's axis.
[[nodiscard]] std::vector<std::string> plan_warnings(const Radar& radar, const CoherentPlan& plan,
                                                     const Rectangle& area, double height_m);

}  // namespace sigmascape::radar
