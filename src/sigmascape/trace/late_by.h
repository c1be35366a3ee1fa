#pragma once

#include "sigmascape/radar/ground_grid.h"
#include "sigmascape/trace/viewpoint.h"

namespace sigmascape::trace {

/// By how much echoes of several bounces that land in `target` may be late where the tallest thing is so tall: H / sin
/// ψ at the lowest grazing angle (trace::multibounce_reach says why), but no less than between slopes of bare ground
/// and no more than a kilometre.
[[nodiscard]] double late_by_m(double tallest_m, const Viewpoint& viewpoint, const radar::Rectangle& target);

}  // namespace sigmascape::trace
