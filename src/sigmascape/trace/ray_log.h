#pragma once

#include <vector>

#include "sigmascape/trace/ray.h"

namespace sigmascape::trace {

/// A ray as it was put to the scene's structures.
struct LoggedRay {
  Ray ray;
  float length_m = 0.0F;    ///< how far it was looked along
  bool asks_first = false;  ///< for the first surface, not merely whether there is any
  bool begins = false;      ///< the first of several that were asked for together
  bool asks_again = false;  ///< from near by for what one before met far away: no ray of its own (TraceCounts::rays)
};

/// Rays in the order in which they were asked for, to be traced again with nothing else in between.
using RayLog = std::vector<LoggedRay>;

}  // namespace sigmascape::trace
