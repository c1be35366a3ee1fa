#pragma once

#include "sigmascape/render/level_of_detail.h"
#include "sigmascape/render/live_ground.h"

namespace sigmascape::render {

/// The question, with what a ground has to offer: texels and their levels, terrain and its levels, and where its
/// shadows come from.
[[nodiscard]] DetailQuestion with_ground(DetailQuestion question, const LiveGround& ground);

}  // namespace sigmascape::render
