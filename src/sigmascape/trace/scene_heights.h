#pragma once

#include "sigmascape/scene/scene.h"
#include "sigmascape/trace/scene_geometry.h"

namespace sigmascape::trace {

/// Heights between which all of a scene lies on a footing, relative to height zero of the frame.
struct SceneHeights {
  double lowest_m = 0.0, highest_m = 0.0;
  double highest_ground_m = 0.0;  ///< of the footing alone
};
/// Looks at everything that stands in the scene: who needs them often keeps them.
[[nodiscard]] SceneHeights heights_of(const scene::Scene& scene, Footing footing);

}  // namespace sigmascape::trace
