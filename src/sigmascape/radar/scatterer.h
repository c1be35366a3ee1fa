#pragma once

#include "sigmascape/base/vec.h"
#include "sigmascape/radar/complex_channels.h"

namespace sigmascape::radar {

/// A point of the ground that answers with a phase of its own.
struct Scatterer {
  Vec3d position;  ///< local frame
  /// |a|² is its cross-section in m²; the phase of the way out and back is not in it.
  ComplexChannels amplitude_m;
  float range_rate_mps = 0.0F;  ///< its own, away from the radar: that of leaves in the wind
};

}  // namespace sigmascape::radar
