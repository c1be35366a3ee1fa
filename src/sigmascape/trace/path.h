#pragma once

#include <cstddef>
#include <vector>

#include "sigmascape/base/vec.h"
#include "sigmascape/scatter/field.h"

namespace sigmascape::trace {

/// What a path carries at one frequency. All frequencies share the path, which was drawn from the densities of one of
/// them, its hero; docs/physics/estimator.md, Eq. (9).
struct Wave {
  scatter::FieldPair fields;  ///< divided by the square root of the hero's density
  /// Density with which this frequency as hero would have drawn the path, over the hero's.
  float forward = 1.0F;
  /// Density with which this frequency as hero would draw the reversed path, over the hero's density of the path;
  /// without the terms of the connection to the radar.
  float reverse = 1.0F;
};

/// One path on its way through the scene.
struct Path {
  Vec3f origin;
  Vec3f direction;
  std::size_t hero = 0;     ///< the frequency whose densities draw the directions
  std::vector<Wave> waves;  ///< one a frequency
  Vec3d first_position;     ///< of the first vertex, in the world
  double first_range_m = 0.0;
  double travelled_m = 0.0;  ///< between vertices
  float first_cosine = 1.0F;

  /// Density of the path, whichever frequency were its hero, over the hero's own. One for a single frequency.
  [[nodiscard]] float mean_forward() const {
    float sum = 0.0F;
    for (const Wave& wave : waves) sum += wave.forward;
    return sum / static_cast<float>(waves.size());
  }

  /// The power that it carries at the frequency where that is greatest, over the power sent.
  [[nodiscard]] float greatest_power() const {
    float greatest = 0.0F;
    for (const Wave& wave : waves) greatest = wave.fields.mean_power() > greatest ? wave.fields.mean_power() : greatest;
    return greatest / mean_forward();
  }
};

}  // namespace sigmascape::trace
