#pragma once

#include <array>
#include <span>

#include "sigmascape/live/horizon_map.h"
#include "sigmascape/live/terrain_sectors.h"
#include "sigmascape/receiver/target_frame.h"

namespace sigmascape::live {

/// What stands before the targets of a frame: for one level of detail, or for two while one gives way to the next.
struct TargetSight {
  struct Level {
    const HorizonMap* horizon = nullptr;        ///< swept already
    std::span<const Occluders> occluders = {};  ///< sector by sector
    float share = 1.0F;
  };
  std::array<Level, 2> levels = {};
  TerrainSectors sectors = {};
  std::size_t azimuths_a_beam = 1;  ///< of the horizons
  Vec3d radar = {};

  /// The part of a target's power that gets through: what stands below its own line of sight hides none of it. A target
  /// does not stand below the ground of the frame, which may be coarser than that on which it was put.
  [[nodiscard]] float part_seen(const receiver::TargetFrame::Seen& target) const;
};

}  // namespace sigmascape::live
