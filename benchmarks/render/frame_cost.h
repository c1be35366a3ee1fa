#pragma once

#include "sigmascape/live/live_renderer.h"

namespace sigmascape::bench {

/// A frame after all pages that it wants are there.
const live::Frame& settled(live::LiveRenderer& renderer, live::LiveGround& ground, const live::Pose& pose);

/// What a settled frame takes, the least of several.
struct FrameCost {
  double wall = 1e30, processor = 1e30;  ///< seconds
  double median_wall = 0.0;
  live::FrameReport report;
};
[[nodiscard]] FrameCost frame_cost(live::LiveRenderer& renderer, live::LiveGround& ground, const live::Pose& pose,
                                   int repetitions);

}  // namespace sigmascape::bench
