#pragma once

#include "sigmascape/base/vec.h"

namespace sigmascape::trace {

struct Ray {
  Vec3f origin;  ///< relative to the geometry's origin
  Vec3f direction;
};

/// In which order rays are put to Embree; of no consequence but for time.
enum class RayOrder {
  AsGiven,  ///< whoever asks has them in a good one
  ByPlace,  ///< as RaySorter finds it
};

}  // namespace sigmascape::trace
