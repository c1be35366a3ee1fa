#pragma once

#include <cstdint>
#include <memory>

#include "sigmascape/live/live_ground.h"

namespace sigmascape::bench {

struct TurningScan {
  double p99 = 0.0, processor = 0.0;                  ///< seconds a step
  double coarse_first_turn = 0.0, coarse_part = 0.0;  ///< of the cells of the first turn, and of the later ones
  std::uint64_t pages_first_turn = 0, pages = 0;      ///< read in that, and after it
  double terrain_error_m = 0.0;                       ///< the greatest of the last turn
};

/// An antenna that turns once in about two seconds, carried northwards at 250 m/s, sixty steps a second of real time:
/// whoever reads pages has the time between them.
[[nodiscard]] TurningScan turning_scan(const std::shared_ptr<live::LiveGround>& ground, double seconds);

}  // namespace sigmascape::bench
