#pragma once

#include <array>

#include "sigmascape/receiver/target_frame.h"
#include "sigmascape/render/horizon_map.h"

namespace sigmascape::render {

/// What stands before the targets of a frame: for one level of detail, or for two while one gives way to the next.
struct TargetSight {
  struct Level {
    const HorizonMap* horizon = nullptr;  ///< swept already
    const Occluders* occluders = nullptr;
    float share = 1.0F;
  };
  std::array<Level, 2> levels = {};
  double radar_height_m = 0.0;

  /// The part of a target's power that gets through. A target does not stand below the ground of the frame, which may
  /// be coarser than that on which it was put.
  [[nodiscard]] float part_seen(const receiver::TargetFrame::Seen& target) const;
};

}  // namespace sigmascape::render
