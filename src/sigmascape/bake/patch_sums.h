#pragma once

#include <optional>

#include "sigmascape/receiver/ground_accumulator.h"

namespace sigmascape::bake {

/// What is summed up of a patch at one frequency.
struct PatchSums {
  receiver::GroundAccumulator all;
  /// What of it came over several surfaces; where that is asked for.
  std::optional<receiver::GroundAccumulator> several = {};
  /// What buildings return directly, which is not in the above; where they are kept apart.
  std::optional<receiver::GroundAccumulator> buildings = {};
};

}  // namespace sigmascape::bake
