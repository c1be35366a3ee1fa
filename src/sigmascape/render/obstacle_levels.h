#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "sigmascape/atlas/store.h"
#include "sigmascape/radar/ground_grid.h"
#include "sigmascape/radar/obstacle.h"

namespace sigmascape::render {

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

/// Obstacles of one size of squares.
struct ObstacleLevel {
  radar::GroundGrid grid;
  std::vector<PackedObstacle> of;  ///< [row][column], north up

  [[nodiscard]] PackedObstacle at(Vec2d point) const {
    const Vec2d cell = grid.cells_from(point);
    if (!(cell.x >= 0.0 && cell.y >= 0.0 && cell.x < static_cast<double>(grid.columns) &&
          cell.y < static_cast<double>(grid.rows))) {
      return {};
    }
    return of[static_cast<std::size_t>(cell.y) * grid.columns + static_cast<std::size_t>(cell.x)];
  }
};

/// What stands on the ground of an atlas that keeps it apart, finer and coarser.
class ObstacleLevels {
 public:
  /// Nothing stands anywhere.
  ObstacleLevels() = default;
  /// Reads patch after patch and leaves out the finest levels that the budget does not hold. Throws Error when a
  /// patch's obstacles are not there.
  ObstacleLevels(const atlas::Store& atlas, std::size_t budget_bytes);

  [[nodiscard]] bool empty() const { return levels_.empty(); }
  [[nodiscard]] std::size_t bytes() const;
  /// Of the tallest thing above its ground.
  [[nodiscard]] float tallest_m() const { return tallest_m_; }
  /// The coarsest level whose squares are no larger than `most_m`, else the finest. Not to be asked when empty.
  [[nodiscard]] const ObstacleLevel& level_for(double most_m) const;

 private:
  std::vector<ObstacleLevel> levels_;  // each twice as coarse as the one before
  float tallest_m_ = 0.0F;
};

}  // namespace sigmascape::render
