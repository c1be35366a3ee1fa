#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "sigmascape/base/vec.h"
#include "sigmascape/live/horizon_grid.h"
#include "sigmascape/live/horizon_lead.h"
#include "sigmascape/live/horizon_steps.h"
#include "sigmascape/live/obstacle_mosaic.h"
#include "sigmascape/live/occluders.h"
#include "sigmascape/radar/look.h"
#include "sigmascape/radar/rectangle_parts.h"
#include "sigmascape/terrain/terrain_view.h"

namespace sigmascape::live {

/// Steps are cut into strides no wider than the squares that obstacles stand on: what is narrower than a step must not
/// slip through. Where nothing stands anywhere they are whole.
struct HorizonStrides {
  std::size_t a_step;
  double length_m, first_m = 0.0;

  /// Of the steps before the map's first node: each is cut about its middle.
  static HorizonStrides to_near(const LeadSteps& lead, const Occluders& occluders) {
    HorizonStrides strides(lead.step_m, occluders.obstacles_before(), occluders.tallest_m);
    strides.first_m = lead.from_m - 0.5 * (lead.step_m - strides.length_m);
    return strides;
  }
  /// Of the map's own: the last stride of each is at its node.
  static HorizonStrides within(const HorizonGrid& grid, const Occluders& occluders) {
    HorizonStrides strides(grid.step_m, *occluders.obstacles, occluders.tallest_m);
    strides.first_m = grid.near_m - static_cast<double>(strides.a_step - 1) * strides.length_m;
    return strides;
  }
  /// Those of the map's first step that lie before its node where steps before it have gone over them.
  [[nodiscard]] std::size_t passed(const LeadSteps& lead) const { return lead.count > 0 ? a_step - 1 : 0; }

 private:
  HorizonStrides(double step_m, const ObstacleMosaic& obstacles, float tallest_m)
      : a_step(tallest_m > 0.0F ? static_cast<std::size_t>(std::max(std::ceil(step_m / obstacles.grid().cell_m), 1.0))
                                : 1),
        length_m(step_m / static_cast<double>(a_step)) {}
};

/// One direction, from the first thing that can hide anything to the last node.
class HorizonWalk {
 public:
  HorizonWalk(const HorizonGrid& grid, std::size_t azimuth, Vec3d radar, const Occluders& occluders)
      : HorizonWalk(grid, static_cast<double>(azimuth), radar, occluders) {}
  /// `across`: the azimuth in directions of the map.
  HorizonWalk(const HorizonGrid& grid, double across, Vec3d radar, const Occluders& occluders)
      : grid_(grid),
        radar_(radar),
        occluders_(occluders),
        direction_(radar::horizontal_direction(grid.first_azimuth_rad + across * grid.azimuth_step_rad)) {}

  /// Calls `step(number, i)` outwards for `count` steps, of which `steps()` then holds some, this one at `i`. Many at
  /// once that lie off the ground hide nothing and are not looked up: of those `off_ground(first, end)` is called.
  template <typename Step, typename OffGround>
  void over(const terrain::TerrainView& ground, const ObstacleMosaic* obstacles, double first_m, double step_m,
            std::size_t count, Step step, OffGround off_ground) {
    for (std::size_t first = 0; first < count; first += steps_together) {
      steps_.count = std::min(steps_together, count - first);
      const double distance_m = first_m + static_cast<double>(first) * step_m;
      const Vec2d from = Vec2d{radar_.x, radar_.y} + direction_ * distance_m;
      if (lies_off(ground, from, static_cast<double>(steps_.count) * step_m)) {
        off_ground(first, first + steps_.count);
        continue;
      }
      steps_.first_m = static_cast<float>(distance_m);
      steps_.step_m = static_cast<float>(step_m);
      const Vec2d nodes = ground.nodes_to(from);
      const double nodes_a_step = step_m / ground.spacing_m;
      look_up_ground(steps_, {nodes.x, direction_.x * nodes_a_step, steps_.count, ground.first_column, ground.columns},
                     {nodes.y, -direction_.y * nodes_a_step, steps_.count, ground.first_row, ground.rows},
                     ground.height_m.data(), static_cast<std::int32_t>(ground.columns),
                     static_cast<float>(radar_.z) + occluders_.lowered_m, static_cast<float>(grid_.drop_per_square_m));
      if (obstacles != nullptr) {
        const Vec2d cell = obstacles->grid().cells_from(from);
        const double cells_a_step = step_m / obstacles->grid().cell_m;
        look_up_obstacles(steps_, *obstacles, static_cast<float>(cell.x), static_cast<float>(cell.y),
                          static_cast<float>(direction_.x * cells_a_step),
                          static_cast<float>(-direction_.y * cells_a_step));
      }
      for (std::size_t i = 0; i < steps_.count; ++i) step(first + i, i);
    }
  }
  /// The same where steps off the ground are nothing to anybody.
  template <typename Step>
  void over(const terrain::TerrainView& ground, const ObstacleMosaic* obstacles, double first_m, double step_m,
            std::size_t count, Step step) {
    over(ground, obstacles, first_m, step_m, count, step, [](std::size_t, std::size_t) {});
  }

  [[nodiscard]] const HorizonSteps& steps() const { return steps_; }
  [[nodiscard]] Vec2d direction() const { return direction_; }

 private:
  /// Whether all from a place to one so far along the direction is off the ground, wherever rounding puts the steps.
  [[nodiscard]] bool lies_off(const terrain::TerrainView& ground, Vec2d from, double length_m) const {
    constexpr double rounding = 1e-6;  // of steps that are counted in single precision, over all of them
    const radar::Rectangle near_ground = radar::widened(ground.extent(), ground.spacing_m + rounding * length_m);
    const Vec2d to = from + direction_ * length_m;
    return std::max(from.x, to.x) < near_ground.west_m || std::min(from.x, to.x) > near_ground.east_m ||
           std::max(from.y, to.y) < near_ground.south_m || std::min(from.y, to.y) > near_ground.north_m;
  }

  const HorizonGrid& grid_;
  Vec3d radar_;
  const Occluders& occluders_;
  Vec2d direction_;
  HorizonSteps steps_;
};

}  // namespace sigmascape::live
