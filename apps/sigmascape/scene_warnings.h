#pragma once

#include "sigmascape/scene/scene.h"

namespace sigmascape::cli {

/// Says on standard error, a line each, what of the scene's remarks is likely a mistake, as a file of which nothing was
/// used: whoever works on with it should know. `scene info` tells all of them.
void warn_of_scene(const scene::Scene& scene);

}  // namespace sigmascape::cli
