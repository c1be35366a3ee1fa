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

/// All that a tracer asks about a wave that leaves in a given direction.
struct Passage {
  FieldPair fields;          ///< that leave; see SurfaceModel::scatter
  float pdf = 0.0F;          ///< density with which the direction would have been drawn, 1/sr
  float reverse_pdf = 0.0F;  ///< the same for the way back
};

}  // namespace sigmascape::scatter
