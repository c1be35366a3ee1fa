#pragma once

#include <cstddef>

#include "sigmascape/live/live_renderer.h"

namespace sigmascape::bench {

/// What a frame reads and writes, counted once however often it does so.
struct Touched {
  std::size_t terrain_nodes = 0;   ///< between the first and the last beam, from the radar to the last range
  std::size_t obstacle_cells = 0;  ///< likewise; none where the textures hold the shadows
  double bytes = 0.0;              ///< of both, of texels, of the horizon map and of the bins
};

[[nodiscard]] Touched touched_by(const live::Frame& frame, const live::LiveSettings& settings, const live::Pose& pose,
                                 const live::LiveGround& ground);

}  // namespace sigmascape::bench
