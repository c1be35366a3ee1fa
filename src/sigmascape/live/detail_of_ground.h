#pragma once

#include "sigmascape/live/live_ground.h"
#include "sigmascape/render/level_of_detail.h"

namespace sigmascape::live {

/// The question, with what a ground has to offer: texels and their levels, terrain and its levels, and where its
/// shadows come from.
[[nodiscard]] render::DetailQuestion with_ground(render::DetailQuestion question, const LiveGround& ground);

}  // namespace sigmascape::live
