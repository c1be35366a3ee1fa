#pragma once

#include "sigmascape/bake/bake_settings.h"
#include "sigmascape/scene/scene.h"

namespace sigmascape::bake {

/// About how many cells one patch of the scene sends rays to, gutters included, at the elevation that asks for most:
/// within a few percent before any are spared, and of texels of any size within a moment.
[[nodiscard]] double cells_of_a_patch(const scene::Scene& scene, const BakeSettings& settings);

/// Bytes of memory that the texels of a patch take: sums at all frequencies, for what is baked is kept for every texel
/// until the last ray, and over relief beside them what stands on the texels, by which the terrain's shadows are taken
/// out; or before them, where the ground is kept apart, what stands there alone.
[[nodiscard]] double bytes_of_texels(const scene::Scene& scene, const BakeSettings& settings);

/// Throws Error when the list of these cells, or these texels, alone take more than so many bytes of memory. Nothing of
/// that size is allocated for the answer.
void check_room(const scene::Scene& scene, const BakeSettings& settings, double memory_bytes);
/// The same for the memory that this machine has.
void check_room(const scene::Scene& scene, const BakeSettings& settings);

}  // namespace sigmascape::bake
