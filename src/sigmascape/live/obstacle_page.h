#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "sigmascape/atlas/tile_address.h"
#include "sigmascape/live/shortage.h"
#include "sigmascape/radar/obstacle.h"

namespace sigmascape::live {

/// An obstacle in eight bytes: heights in steps of 1/64 m, extinction in steps of 1/8192 per metre.
struct PackedObstacle {
  static constexpr float per_height_m = 64.0F, per_extinction = 8192.0F;
  std::uint16_t solid_top = 0, crown_base = 0, crown_top = 0, crown_extinction = 0;

  [[nodiscard]] static PackedObstacle packed(const radar::Obstacle& obstacle);
  [[nodiscard]] radar::Obstacle unpacked() const {
    return {static_cast<float>(solid_top) / per_height_m, static_cast<float>(crown_base) / per_height_m,
            static_cast<float>(crown_top) / per_height_m, static_cast<float>(crown_extinction) / per_extinction};
  }
};

/// What stands on 256 × 256 squares of ground.
struct ObstaclePage {
  atlas::TileAddress key;
  std::vector<PackedObstacle> of;  ///< [row][column], north up
  /// By how many levels what it was made from is coarser than it should be, for the tile itself cannot be read.
  std::size_t levels_lacking = 0;
  mutable AnotherTry another_try;
  mutable std::atomic<std::uint64_t> last_wanted{0};  ///< number of the frame that last read it

  static constexpr std::size_t squares = atlas::tile_side * atlas::tile_side;

  [[nodiscard]] std::size_t level() const { return key.level; }
};

}  // namespace sigmascape::live
