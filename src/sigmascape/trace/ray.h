#pragma once

#include "sigmascape/base/vec.h"

namespace sigmascape::trace {

struct Ray {
  Vec3f origin;  ///< relative to the geometry's origin
  Vec3f direction;
};

}  // namespace sigmascape::trace
