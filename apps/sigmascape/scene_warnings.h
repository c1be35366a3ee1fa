#pragma once

#include "sigmascape/scene/scene.h"

namespace sigmascape::cli {

/// Says scene::warnings_of() on standard error. `scene info` tells all remarks.
void warn_of_scene(const scene::Scene& scene);

}  // namespace sigmascape::cli
