#pragma once

#include "sigmascape/radar/ground_grid.h"
#include "sigmascape/scene/scene.h"

namespace sigmascape::trace {

/// Throws Error, which names a spacing that would do, when a scene's ground and what rays need over so much of it,
/// which is not there yet, take more than so many bytes.
void require_room(const scene::Scene& scene, const radar::Rectangle& part, double memory_bytes);

}  // namespace sigmascape::trace
