#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "sigmascape/base/vec.h"
#include "sigmascape/live/live_settings.h"
#include "sigmascape/radar/range_azimuth_image.h"
#include "sigmascape/radar/target.h"

namespace sigmascape::live {

/// Where the radar is and where its bins begin.
struct Pose {
  Vec3d position;                  ///< local frame, height above mean sea level
  double first_azimuth_rad = 0.0;  ///< left edge of beam 0, clockwise from north
  double first_range_m = 1000.0;   ///< near edge of range bin 0
  Vec3d velocity_mps = {};         ///< says which ground to fetch ahead of time
  /// Targets and movers that answer besides the ground, at every level of detail, wherever nothing stands before them;
  /// those with a size hide the ground behind them. They must live until the frame is done.
  std::span<const radar::Target> targets = {};
  radar::Moment moment = {};  ///< of the targets' tracks and of their fluctuation
};

/// Throws Error at `where` for what is not a number, for ranges that begin behind the radar, and for places, ranges and
/// velocities that are beyond all that a radar looks at from the Earth.
void check(const Pose& pose, const std::string& where);

/// Where the bins of a frame lie.
[[nodiscard]] radar::RangeAzimuthGrid bins_of(const LiveSettings& settings, const Pose& pose);

/// Throws Error for a step of a scan of no beams, and for one that begins behind the last of `beams`. One that goes on
/// behind the last is of those that are there.
void check_step(std::size_t first_beam, std::size_t count, std::size_t beams);

}  // namespace sigmascape::live
