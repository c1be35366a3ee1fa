#pragma once

#include <memory>

#include "sigmascape/live/live_renderer.h"
#include "sigmascape/radar/radar.h"

namespace sigmascape::bench {

/// Processor seconds that watts of a settled frame take, the least of several.
struct HearingCost {
  double first = 0.0;                            ///< of the first frame that a receiver hears
  double step = 1e30, frame = 1e30;              ///< 8 beams of it, and all, from where they were heard before
  double moved_step = 1e30, moved_frame = 1e30;  ///< the same from a metre beside that
  double image = 1e30;                           ///< of image_of and receiver::received_power
};

/// Proves first that both ways come to the same. `radar` is even in elevation or not.
[[nodiscard]] HearingCost hearing_cost(const std::shared_ptr<live::LiveGround>& ground, const radar::Radar& radar,
                                       const live::LiveSettings& settings, const live::Pose& pose, int repetitions);

}  // namespace sigmascape::bench
