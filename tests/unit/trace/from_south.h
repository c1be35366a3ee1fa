#pragma once

#include "sigmascape/base/units.h"
#include "sigmascape/trace/viewpoint.h"

namespace sigmascape::trace {

/// Far away, 30° above the horizon.
inline const Viewpoint from_south = Viewpoint::distant({pi, radians_from_deg(30.0)});

}  // namespace sigmascape::trace
