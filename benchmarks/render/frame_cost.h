#pragma once

#include "sigmascape/render/live_renderer.h"

namespace sigmascape::bench {

/// A frame after all pages that it wants are there.
const render::Frame& settled(render::LiveRenderer& renderer, render::LiveGround& ground, const render::Pose& pose);

/// What a settled frame takes, the least of several.
struct FrameCost {
  double wall = 1e30, processor = 1e30;  ///< seconds
  double median_wall = 0.0;
  render::FrameReport report;
};
[[nodiscard]] FrameCost frame_cost(render::LiveRenderer& renderer, render::LiveGround& ground, const render::Pose& pose,
                                   int repetitions);

}  // namespace sigmascape::bench
