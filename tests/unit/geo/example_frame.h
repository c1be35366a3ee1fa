#pragma once

#include "sigmascape/geo/local_frame.h"

namespace sigmascape::geo {

/// Near Bilbao.
inline const LocalFrame example_frame(43.312, -2.986);

}  // namespace sigmascape::geo
