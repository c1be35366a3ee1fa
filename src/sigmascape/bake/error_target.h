#pragma once

#include <optional>

#include "sigmascape/atlas/texels_above_target.h"
#include "sigmascape/bake/look_baker.h"
#include "sigmascape/bake/sampling.h"

namespace sigmascape::bake {

/// How many texels return anything, and how many of these have a standard error above the target; nothing when there is
/// none. A target is one for what the rays of a cell return (docs/decisions/0015-adaptive-sampling.md), so that texels
/// may miss it.
[[nodiscard]] std::optional<atlas::TexelsAboveTarget> texels_above_target(const BakedLook& look,
                                                                          const Sampling& sampling);

}  // namespace sigmascape::bake
