#pragma once

#include <span>

#include "sigmascape/atlas/buildings.h"
#include "sigmascape/scene/scene.h"

namespace sigmascape::bake {

/// The buildings of a scene as an atlas keeps them apart, those about its extent that may lie over into it included:
/// every face where it stands on the terrain, and what each of their materials returns by angle at each of the
/// frequencies. Throws Error for materials that are not known there.
[[nodiscard]] atlas::Buildings buildings_of(const scene::Scene& scene, std::span<const double> frequencies_hz);

}  // namespace sigmascape::bake
