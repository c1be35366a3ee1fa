#pragma once

#include "sigmascape/radar/channels.h"
#include "sigmascape/scatter/field.h"

namespace sigmascape::scatter {

/// A direction drawn to carry a path on, and its density per steradian; density 0 says that the path ends here.
struct DirectionSample {
  Vec3f direction;
  float pdf = 0.0F;
};

/// The uniform numbers in [0, 1) from which one vertex draws the phases that its unresolved roughness gives.
struct PhaseDraw {
  float a = 0.0F;
  float b = 0.0F;
};

}  // namespace sigmascape::scatter
