#pragma once

#include "sigmascape/scene/scene.h"
#include "sigmascape/trace/scene_geometry.h"

namespace sigmascape::trace {

/// Heights between which all of a scene lies on a footing, relative to height zero of the frame.
struct SceneHeights {
  double lowest_m = 0.0, highest_m = 0.0;
};
[[nodiscard]] SceneHeights heights_of(const scene::Scene& scene, Footing footing);

}  // namespace sigmascape::trace
