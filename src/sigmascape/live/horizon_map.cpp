#include "sigmascape/live/horizon_map.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "sigmascape/base/vector_targets.h"
#include "sigmascape/live/crown_depth.h"
#include "sigmascape/live/lesser_greater.h"
#include "sigmascape/radar/look.h"
#include "sigmascape/radar/rectangle_parts.h"
#include "sigmascape/terrain/obstacle_sweep.h"
#include "sigmascape/terrain/roof_doubt.h"

namespace sigmascape::live {
namespace {

/// Steps that are looked up together.
constexpr std::size_t together = 256;
constexpr float no_ground = -1e30F;

/// Some steps along a direction, on the lattice of the terrain and on that of obstacles.
struct Steps {
  std::size_t count = 0;
  float first_m = 0.0F, step_m = 1.0F;
  alignas(64) std::array<float, together> distance_m, slope;
  alignas(64) std::array<std::int32_t, together> square;  // of the obstacles; −1 outside
  std::array<PackedObstacle, together> obstacle;
};

/// Where steps lie along one side of a lattice, in its nodes, counted from a node of its own just before all of them:
/// which piece of the lattice is at hand makes no difference to a bit.
struct StepsAlong {
  float first = 0.0F, a_step = 0.0F;
  // The piece, counted from the same node.
  float begin = 0.0F, end = 0.0F;  // outer nodes
  std::int32_t first_node = 0, last_cell = 0;

  StepsAlong(double from, double nodes_a_step, std::size_t steps, std::int64_t piece_begin, std::size_t piece_nodes)
      : a_step(static_cast<float>(nodes_a_step)) {
    const double node = std::floor(std::min(from, from + nodes_a_step * static_cast<double>(steps))) - 1.0;
    first = static_cast<float>(from - node);
    // What is farther away is outside as well, and floats count no farther node by node.
    constexpr double far_outside = 1 << 23;
    first_node =
        static_cast<std::int32_t>(std::clamp(static_cast<double>(piece_begin) - node, -far_outside, far_outside));
    last_cell = first_node + static_cast<std::int32_t>(piece_nodes) - 2;
    begin = static_cast<float>(first_node);
    end = static_cast<float>(last_cell + 1);
  }
};

/// Slopes of the lines of sight to the bilinear ground under the steps.
SIGMASCAPE_VECTOR_TARGETS
void look_up_ground(Steps& steps, const StepsAlong& eastward, const StepsAlong& southward, const float* height_m,
                    std::int32_t columns, float radar_height_m, float drop_per_square_m) {
  SIGMASCAPE_INDEPENDENT_TURNS
  for (std::size_t i = 0; i < steps.count; ++i) {
    const auto k = static_cast<float>(static_cast<std::int32_t>(i));
    const float distance = steps.first_m + k * steps.step_m;
    const float across = eastward.first + k * eastward.a_step;
    const float down = southward.first + k * southward.a_step;
    const float x = lesser(greater(across, eastward.begin), eastward.end);
    const float y = lesser(greater(down, southward.begin), southward.end);
    const auto left = std::min(static_cast<std::int32_t>(x), eastward.last_cell);
    const auto upper = std::min(static_cast<std::int32_t>(y), southward.last_cell);
    const float u = x - static_cast<float>(left), v = y - static_cast<float>(upper);
    const std::int32_t index = (upper - southward.first_node) * columns + left - eastward.first_node;
    const float north = height_m[index] + u * (height_m[index + 1] - height_m[index]);
    const float south = height_m[index + columns] + u * (height_m[index + columns + 1] - height_m[index + columns]);
    const float height = north + v * (south - north);
    const float slope = (height - radar_height_m) / distance - drop_per_square_m * distance;
    // A hair's breadth outside is inside: rounding must not tear the edge.
    const float outside = greater(std::abs(across - x), std::abs(down - y));
    steps.distance_m[i] = distance;
    steps.slope[i] = outside <= 1e-3F ? slope : no_ground;
  }
}

/// The squares of obstacles that the steps fall into, numbered tile by tile (ObstacleMosaic::at).
SIGMASCAPE_VECTOR_TARGETS
void look_up_squares(Steps& steps, float first_column, float first_row, float columns_a_step, float rows_a_step,
                     std::int32_t tiles_across, std::int32_t tiles_down) {
  constexpr auto side = static_cast<std::int32_t>(atlas::tile_side);
  const auto width = static_cast<float>(tiles_across * side), height = static_cast<float>(tiles_down * side);
  SIGMASCAPE_INDEPENDENT_TURNS
  for (std::size_t i = 0; i < steps.count; ++i) {
    const auto k = static_cast<float>(static_cast<std::int32_t>(i));
    const float across = first_column + k * columns_a_step, down = first_row + k * rows_a_step;
    const bool inside = (across >= 0.0F) & (down >= 0.0F) & (across < width) & (down < height);
    const auto column = static_cast<std::int32_t>(lesser(greater(across, 0.0F), width - 1.0F));
    const auto row = static_cast<std::int32_t>(lesser(greater(down, 0.0F), height - 1.0F));
    const std::int32_t tile = row / side * tiles_across + column / side;
    steps.square[i] = inside ? (tile * side + row % side) * side + column % side : -1;
  }
}

/// What stands on the squares. They are far apart in memory: read before the first step is taken, none waits for what
/// is made of the one before it.
void look_up_obstacles(Steps& steps, const ObstacleMosaic& obstacles) {
  for (std::size_t i = 0; i < steps.count; ++i) {
    steps.obstacle[i] = steps.square[i] < 0 ? PackedObstacle{} : obstacles.at(steps.square[i]);
  }
}

const terrain::TerrainView& ground_before(const Occluders& occluders) {
  return occluders.before_near.columns > 0 ? occluders.before_near : occluders.terrain;
}

const ObstacleMosaic& obstacles_before(const Occluders& occluders) {
  return occluders.obstacles_before_near != nullptr ? *occluders.obstacles_before_near : *occluders.obstacles;
}

/// Of the ground before the first node and beyond, as low as it may be, and of what stands on it.
terrain::HeightBounds bounds_of(const Occluders& occluders) {
  const terrain::TerrainView &within = occluders.terrain, &before = ground_before(occluders);
  return {std::min(within.lowest_m, before.lowest_m) - occluders.lowered_m,
          std::max(within.highest_m, before.highest_m) + occluders.tallest_m};
}

/// No ground nearer than this can hide any of the map's.
///
/// Over the round Earth the line of sight from the radar's height H to ground of height h at the distance d runs, x
/// from the radar, H − x ((H − h)/d + q (d − x)) high, with q = 1/(2 k R) (docs/physics/curved_earth.md, Eq. (2)). For
/// the lowest h this is the first x at which it comes down to the highest of all that stands there. How steeply it
/// sets out, (H − h)/d + q d, is greatest at one of the map's two ends: that line comes down nearest.
double nearest_occluder_m(const HorizonGrid& grid, Vec3d radar, const terrain::HeightBounds& bounds) {
  const double above_lowest_m = radar.z - static_cast<double>(bounds.lowest_m);
  const double above_highest_m = radar.z - static_cast<double>(bounds.highest_m);
  if (above_highest_m <= 0.0) return 0.0;
  const auto clear_of = [&](double distance_m) {
    const double drop = grid.drop_per_square_m, fall = above_lowest_m / distance_m + drop * distance_m;
    // Of q x² − (fall) x + (H − highest) = 0, in a form that holds for q = 0 too.
    const double under_root = std::max(fall * fall - 4.0 * drop * above_highest_m, 0.0);
    return 2.0 * above_highest_m / (fall + std::sqrt(under_root));
  };
  return std::min(clear_of(grid.near_m), clear_of(grid.near_m + static_cast<double>(grid.distances) * grid.step_m));
}

/// Steps are cut into strides no wider than the squares that obstacles stand on: what is narrower than a step must not
/// slip through. Where nothing stands anywhere they are whole.
struct Strides {
  std::size_t a_step;
  double length_m, first_m = 0.0;

  /// Of the steps before the map's first node: each is cut about its middle.
  static Strides to_near(const LeadSteps& lead, const Occluders& occluders) {
    Strides strides(lead.step_m, obstacles_before(occluders), occluders.tallest_m);
    strides.first_m = lead.from_m - 0.5 * (lead.step_m - strides.length_m);
    return strides;
  }
  /// Of the map's own: the last stride of each is at its node.
  static Strides within(const HorizonGrid& grid, const Occluders& occluders) {
    Strides strides(grid.step_m, *occluders.obstacles, occluders.tallest_m);
    strides.first_m = grid.near_m - static_cast<double>(strides.a_step - 1) * strides.length_m;
    return strides;
  }
  /// Those of the map's first step that lie before its node where steps before it have gone over them.
  [[nodiscard]] std::size_t passed(const LeadSteps& lead) const { return lead.count > 0 ? a_step - 1 : 0; }

 private:
  Strides(double step_m, const ObstacleMosaic& obstacles, float tallest_m)
      : a_step(tallest_m > 0.0F ? static_cast<std::size_t>(std::max(std::ceil(step_m / obstacles.grid().cell_m), 1.0))
                                : 1),
        length_m(step_m / static_cast<double>(a_step)) {}
};

/// What a line of sight must rise above, as far as a direction has been walked.
struct Horizon {
  float steepest = no_ground;  ///< of ground
  float solid = no_ground;     ///< of solid tops

  /// Goes over a step of `step_m`, the ground under it and what stands there, its crowns unless others have.
  void pass(const Steps& steps, std::size_t i, double step_m, CrownDepth* crowns) {
    // Where the map begins below the radar, strides of its first step lie behind it.
    if (!(steps.distance_m[i] > 0.0F)) return;
    const float slope = steps.slope[i];
    steepest = greater(steepest, slope);
    const PackedObstacle packed = steps.obstacle[i];
    if (slope == no_ground || (packed.solid_top == 0 && packed.crown_top == 0)) return;
    const radar::Obstacle obstacle = packed.unpacked();
    const float per_distance = 1.0F / steps.distance_m[i];
    if (packed.solid_top > 0) solid = greater(solid, slope + obstacle.solid_top_m * per_distance);
    const float top = slope + obstacle.crown_top_m * per_distance;
    if (crowns == nullptr || packed.crown_top == 0 || top <= steepest) return;
    const float base = slope + obstacle.crown_base_m * per_distance;
    CrownOverStride crown{.distance_m = steps.distance_m[i],
                          .stride_m = static_cast<float>(step_m),
                          .base_slope = base,
                          .top_slope = top};
    if (!crowns->comes_upon(crown)) return;
    crown.pieces = terrain::crown_pieces(step_m * static_cast<double>(std::abs(slope)),
                                         static_cast<double>(obstacle.crown_top_m - obstacle.crown_base_m));
    const float way_m = crown.stride_m / static_cast<float>(crown.pieces) * std::sqrt(1.0F + slope * slope);
    crown.depth_a_piece = obstacle.crown_extinction_per_m * way_m;
    crowns->add(crown);
  }
};

/// Optical depth of what stands at a step on a line of sight under `slope`.
double crown_depth_on(const Steps& steps, std::size_t i, double step_m, double slope) {
  const PackedObstacle packed = steps.obstacle[i];
  if (!(steps.distance_m[i] > 0.0F) || steps.slope[i] == no_ground || packed.crown_top == 0) return 0.0;
  const radar::Obstacle obstacle = packed.unpacked();
  const double above_ground_m =
      (slope - static_cast<double>(steps.slope[i])) * static_cast<double>(steps.distance_m[i]);
  const double part = terrain::part_within(obstacle, above_ground_m, 0.5 * step_m * std::abs(slope));
  return part * static_cast<double>(obstacle.crown_extinction_per_m) * step_m * std::hypot(1.0, slope);
}

/// Of the line of sight to the top of what is solid at a step.
double solid_slope_at(const Steps& steps, std::size_t i) {
  const PackedObstacle packed = steps.obstacle[i];
  if (!(steps.distance_m[i] > 0.0F) || steps.slope[i] == no_ground || packed.solid_top == 0)
    return static_cast<double>(no_ground);
  return static_cast<double>(steps.slope[i] + packed.unpacked().solid_top_m / steps.distance_m[i]);
}

}  // namespace

LeadSteps lead_of(const HorizonGrid& grid, Vec3d radar, const Occluders& occluders) {
  return lead_of(grid, radar, bounds_of(occluders));
}

LeadSteps lead_of(const HorizonGrid& grid, Vec3d radar, const terrain::HeightBounds& bounds) {
  const double clear_m = nearest_occluder_m(grid, radar, bounds);
  const double step_m = std::max((grid.near_m - clear_m) / static_cast<double>(grid.before_near), grid.step_m);
  // Nothing lies between the radar and a map that begins below it, however short its steps.
  if (!(step_m > 0.0)) return {grid.near_m, grid.step_m, 0};
  const auto count = static_cast<std::size_t>((grid.near_m - clear_m) / step_m);
  return {grid.near_m - (static_cast<double>(count) - 0.5) * step_m, step_m, count};
}

/// One direction, from the first thing that can hide anything to the last node.
class HorizonMap::Walk {
 public:
  Walk(const HorizonGrid& grid, std::size_t azimuth, Vec3d radar, const Occluders& occluders)
      : Walk(grid, static_cast<double>(azimuth), radar, occluders) {}
  /// `across`: the azimuth in directions of the map.
  Walk(const HorizonGrid& grid, double across, Vec3d radar, const Occluders& occluders)
      : grid_(grid),
        radar_(radar),
        occluders_(occluders),
        direction_(radar::horizontal_direction(grid.first_azimuth_rad + across * grid.azimuth_step_rad)) {}

  /// Calls `step(number, i)` outwards for `count` steps, of which `steps()` then holds some, this one at `i`. Many at
  /// once that lie off the ground hide nothing and are not looked up: of those `off_ground(first, end)` is called.
  template <typename Step, typename OffGround>
  void over(const terrain::TerrainView& ground, const ObstacleMosaic* obstacles, double first_m, double step_m,
            std::size_t count, Step step, OffGround off_ground) {
    for (std::size_t first = 0; first < count; first += together) {
      steps_.count = std::min(together, count - first);
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
        look_up_squares(
            steps_, static_cast<float>(cell.x), static_cast<float>(cell.y),
            static_cast<float>(direction_.x * cells_a_step), static_cast<float>(-direction_.y * cells_a_step),
            static_cast<std::int32_t>(obstacles->block().across), static_cast<std::int32_t>(obstacles->block().down));
        look_up_obstacles(steps_, *obstacles);
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

  [[nodiscard]] const Steps& steps() const { return steps_; }
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
  Steps steps_;
};

HorizonMap::HorizonMap(const HorizonGrid& grid, unsigned workers) : depths_(workers) {
  reset(grid, false);
}

void HorizonMap::reset(const HorizonGrid& grid, bool with_obstacles) {
  grid_ = grid;
  with_obstacles_ = with_obstacles;
  // Whole lines of 64 bytes, an odd number of them.
  constexpr std::size_t line = 16;
  stride_ = ((grid.distances + line - 1) / line | 1U) * line;
  const std::size_t nodes = grid.azimuths * stride_;
  if (slopes_.size() < nodes) slopes_.resize(nodes);
  if (!with_obstacles) return;
  if (solid_slopes_.size() < nodes) solid_slopes_.resize(nodes);
  if (through_.size() < nodes) through_.resize(nodes);
  for (auto& depths : depths_) depths.resize(std::max(depths.size(), grid.distances));
}

void HorizonMap::sweep(std::size_t azimuth, Vec3d radar, const Occluders& occluders, unsigned worker) {
  if (occluders.obstacles == nullptr || !with_obstacles_) {
    sweep_ground(azimuth, radar, occluders);
  } else {
    sweep_obstacles(azimuth, radar, occluders, worker);
  }
}

void HorizonMap::sweep_ground(std::size_t azimuth, Vec3d radar, const Occluders& occluders) {
  Walk walk(grid_, azimuth, radar, occluders);
  const Steps& steps = walk.steps();
  const LeadSteps lead = lead_of(grid_, radar, occluders);
  float steepest = no_ground;
  walk.over(ground_before(occluders), nullptr, lead.from_m, lead.step_m, lead.count,
            [&](std::size_t, std::size_t i) { steepest = greater(steepest, steps.slope[i]); });

  float* const slopes = slopes_.data() + azimuth * stride_;
  walk.over(
      occluders.terrain, nullptr, grid_.near_m, grid_.step_m, grid_.distances,
      [&](std::size_t k, std::size_t i) {
        steepest = greater(steepest, steps.slope[i]);
        slopes[k] = steepest;
      },
      [&](std::size_t first, std::size_t end) { std::fill(slopes + first, slopes + end, steepest); });
}

void HorizonMap::sweep_obstacles(std::size_t azimuth, Vec3d radar, const Occluders& occluders, unsigned worker) {
  // How the ground rises says where the edges of crowns are met.
  sweep_ground(azimuth, radar, occluders);
  float* const slopes = slopes_.data() + azimuth * stride_;
  CrownDepth crowns(std::span(depths_[worker]).first(grid_.distances), std::span(slopes, grid_.distances));

  Walk walk(grid_, azimuth, radar, occluders);
  const Steps& steps = walk.steps();
  const LeadSteps lead = lead_of(grid_, radar, occluders);
  Horizon horizon;
  const Strides to_near = Strides::to_near(lead, occluders);
  walk.over(ground_before(occluders), &obstacles_before(occluders), to_near.first_m, to_near.length_m,
            lead.count * to_near.a_step,
            [&](std::size_t, std::size_t i) { horizon.pass(steps, i, to_near.length_m, &crowns); });

  const Strides within = Strides::within(grid_, occluders);
  float* const solid_slopes = solid_slopes_.data() + azimuth * stride_;
  float* const through = through_.data() + azimuth * stride_;
  float transmission = 1.0F;
  const auto come_to_node = [&](std::size_t k, float slope) {
    crowns.meet(k);
    // Ground behind a ridge is not seen whatever stands in between.
    if (slope >= horizon.steepest) transmission = crowns.transmission();
    slopes[k] = horizon.steepest;
    solid_slopes[k] = horizon.solid;
    through[k] = transmission;
  };
  walk.over(
      occluders.terrain, occluders.obstacles, within.first_m, within.length_m, grid_.distances * within.a_step,
      [&](std::size_t stride, std::size_t i) {
        horizon.pass(steps, i, within.length_m, stride < within.passed(lead) ? nullptr : &crowns);
        if (stride % within.a_step == within.a_step - 1) come_to_node(stride / within.a_step, steps.slope[i]);
      },
      [&](std::size_t first, std::size_t end) {
        for (std::size_t k = first / within.a_step; k < end / within.a_step; ++k) come_to_node(k, no_ground);
      });
}

double HorizonMap::through_from(std::size_t azimuth, std::size_t node, double slope, Vec3d radar,
                                const Occluders& occluders) const {
  // As long as the line of sight is above all that stands, there is nothing to walk through.
  const double over_all_m = radar.z - static_cast<double>(bounds_of(occluders).highest_m);
  if (over_all_m > 0.0 && slope >= 0.0) return 1.0;
  const double clear_m = over_all_m > 0.0 ? over_all_m / -slope : 0.0;
  Walk walk(grid_, azimuth, radar, occluders);
  double depth = 0.0;
  const auto walk_through = [&](const terrain::TerrainView& ground, const ObstacleMosaic& obstacles,
                                const Strides& strides, std::size_t first, std::size_t end) {
    const auto left_out = static_cast<std::size_t>(std::clamp((clear_m - strides.first_m) / strides.length_m,
                                                              static_cast<double>(first), static_cast<double>(end)));
    walk.over(ground, &obstacles, strides.first_m + static_cast<double>(left_out) * strides.length_m, strides.length_m,
              end - left_out,
              [&](std::size_t, std::size_t i) { depth += crown_depth_on(walk.steps(), i, strides.length_m, slope); });
  };
  const LeadSteps lead = lead_of(grid_, radar, occluders);
  const Strides to_near = Strides::to_near(lead, occluders), within = Strides::within(grid_, occluders);
  walk_through(ground_before(occluders), obstacles_before(occluders), to_near, 0, lead.count * to_near.a_step);
  walk_through(occluders.terrain, *occluders.obstacles, within, within.passed(lead), (node + 1) * within.a_step);
  return std::exp(-depth);
}

double HorizonMap::through_beyond(std::size_t azimuth, std::size_t node, double distance_m, double slope, Vec3d radar,
                                  const Occluders& occluders) const {
  const Strides strides = Strides::within(grid_, occluders);
  const double node_m = grid_.near_m + static_cast<double>(node) * grid_.step_m;
  // A stride reaches half its length to either side of its middle, the node's as well.
  const double rest_m = distance_m - node_m - 0.5 * strides.length_m;
  if (!(rest_m > 0.0 && strides.length_m > 0.0)) return 1.0;
  Walk walk(grid_, azimuth, radar, occluders);
  double depth = 0.0;
  walk.over(occluders.terrain, occluders.obstacles, node_m + strides.length_m, strides.length_m,
            static_cast<std::size_t>(std::ceil(rest_m / strides.length_m)), [&](std::size_t number, std::size_t i) {
              const double part = std::min(rest_m / strides.length_m - static_cast<double>(number), 1.0);
              depth += part * crown_depth_on(walk.steps(), i, strides.length_m, slope);
            });
  return std::exp(-depth);
}

bool HorizonMap::is_behind_solid(std::size_t azimuth, double distance_m, double slope, double roof_doubt_m, Vec3d radar,
                                 const Occluders& occluders) const {
  const Strides within = Strides::within(grid_, occluders);
  const double square_m = occluders.obstacles->grid().cell_m;
  // Up to there the nodes know it.
  const double known_m = roof_doubt_m > 0.0 ? distance_m - terrain::most_doubtful_squares * square_m : distance_m;
  const bool is_known = roof_doubt_m == 0.0 || known_m >= grid_.near_m;
  const std::size_t node = grid_.node_before(known_m);
  if (is_known && slope < static_cast<double>(solid_slopes(azimuth)[node])) return true;

  Walk walk(grid_, azimuth, radar, occluders);
  bool is_hidden = false;
  const auto pass = [&](std::size_t, std::size_t i) {
    const double at_m = static_cast<double>(walk.steps().distance_m[i]);
    const double left_m = terrain::doubt_left_m(roof_doubt_m, distance_m - at_m, -slope, square_m);
    is_hidden = is_hidden || slope < solid_slope_at(walk.steps(), i) - left_m / at_m;
  };
  const std::size_t first = is_known ? (node + 1) * within.a_step : 0;
  if (!is_known) {
    const LeadSteps lead = lead_of(grid_, radar, occluders);
    const Strides to_near = Strides::to_near(lead, occluders);
    walk.over(ground_before(occluders), &obstacles_before(occluders), to_near.first_m, to_near.length_m,
              lead.count * to_near.a_step, pass);
  }
  const double first_m = within.first_m + static_cast<double>(first) * within.length_m;
  // Those whose middles lie before the point.
  if (!(within.length_m > 0.0 && distance_m >= first_m)) return is_hidden;
  walk.over(occluders.terrain, occluders.obstacles, first_m, within.length_m,
            static_cast<std::size_t>((distance_m - first_m) / within.length_m) + 1, pass);
  return is_hidden;
}

/// Looks for ground between the nodes that hides one point.
class HorizonMap::Crests {
 public:
  Crests(const HorizonMap& map, double across, double slope, Vec3d radar, const Occluders& occluders)
      : grid_(map.grid_), radar_(radar), occluders_(occluders), across_(across), slope_(slope) {
    const auto left = static_cast<std::size_t>(std::min(across, static_cast<double>(grid_.azimuths - 2)));
    left_ = map.slopes(left);
    right_ = map.slopes(left + 1);
  }

  /// Between the first node, or the point if it lies before it, and the radar.
  bool lie_before(double distance_m) {
    const LeadSteps lead = lead_of(grid_, radar_, occluders_);
    const double from_m = lead.from_m - 0.5 * lead.step_m, to_m = std::min(grid_.near_m, distance_m);
    return lead.count > 0 && can_miss(ground_before(occluders_), lead.step_m) &&
           !is_clear(ground_before(occluders_), 0, from_m, to_m, 0.5 * lead.step_m) &&
           rise_from(ground_before(occluders_), from_m, to_m);
  }
  /// Between the first node and the point, which lies behind that one and before the next.
  bool lie_within(std::size_t node, double distance_m) {
    return can_miss(occluders_.terrain, grid_.step_m) &&
           (lie_behind(node, distance_m) || (node > 0 && lie_between(0, node)));
  }

 private:
  /// Steps that are as short as the places lie where crests are looked for have gone over them.
  static bool can_miss(const terrain::TerrainView& ground, double step_m) {
    return step_m * places_a_cell > ground.spacing_m;
  }

  /// Between two nodes; the farther half first, for targets are nearest to the ground right before them.
  bool lie_between(std::size_t first, std::size_t last) {
    constexpr std::size_t walked_at_once = 4;
    const double from_m = std::max(node_m(first), 0.0), to_m = node_m(last);
    if (is_clear(occluders_.terrain, last, from_m, to_m, 0.5 * grid_.step_m)) return false;
    if (last - first <= walked_at_once) return rise_from(occluders_.terrain, from_m, to_m);
    const std::size_t middle = first + (last - first) / 2;
    return lie_between(middle, last) || lie_between(first, middle);
  }
  /// Between a node and the point, which lies before the next one.
  bool lie_behind(std::size_t node, double distance_m) {
    const double from_m = std::max(node_m(node), 0.0);
    return !is_clear(occluders_.terrain, node, from_m, distance_m, grid_.step_m) &&
           rise_from(occluders_.terrain, from_m, distance_m);
  }

  [[nodiscard]] double node_m(std::size_t node) const {
    return grid_.near_m + static_cast<double>(node) * grid_.step_m;
  }

  /// Whether the line of sight stays above all ground between two distances that is no farther than `reach_m` along
  /// range from a node, none of which rises more steeply than those up to this one.
  [[nodiscard]] bool is_clear(const terrain::TerrainView& ground, std::size_t node, double from_m, double to_m,
                              double reach_m) const {
    const double above_nodes_m = (slope_ - static_cast<double>(std::max(left_[node], right_[node]))) * from_m;
    const double beside_m = 0.5 * grid_.azimuth_step_rad * to_m;
    const double rise_m = std::min(static_cast<double>(ground.steepest) * (reach_m + beside_m),
                                   static_cast<double>(ground.highest_m - ground.lowest_m));
    const double fall_m = (std::abs(slope_) + 2.0 * grid_.drop_per_square_m * to_m) * reach_m;
    if (above_nodes_m > rise_m + fall_m) return true;
    // Lines of sight to the ground fall all the way.
    const double end_m = radar_.z + to_m * (slope_ + grid_.drop_per_square_m * to_m);
    return slope_ + 2.0 * grid_.drop_per_square_m * to_m < 0.0 &&
           end_m > static_cast<double>(ground.highest_m - occluders_.lowered_m);
  }

  /// Where the line crosses rows and columns of the terrain, between which it has no crests, and halfway between,
  /// where saddles are highest: the same places of the ground in every frame.
  bool rise_from(const terrain::TerrainView& ground, double from_m, double to_m) {
    if (!walk_) walk_.emplace(grid_, across_, radar_, occluders_);
    const Vec2d nodes = ground.nodes_to({radar_.x, radar_.y}), direction = walk_->direction();
    return rise_along(ground, nodes.x, direction.x / ground.spacing_m, from_m, to_m) ||
           rise_along(ground, nodes.y, -direction.y / ground.spacing_m, from_m, to_m);
  }
  /// `nodes`: of the radar along one side of the lattice.
  bool rise_along(const terrain::TerrainView& ground, double nodes, double nodes_a_metre, double from_m, double to_m) {
    constexpr double hardly_any = 1e-3;
    const double places_a_metre = places_a_cell * nodes_a_metre,
                 start = places_a_cell * nodes + from_m * places_a_metre;
    if (!(std::abs(places_a_metre) * (to_m - from_m) > hardly_any)) return false;
    const double step_m = 1.0 / std::abs(places_a_metre);
    const double first_m =
        from_m + step_m * (places_a_metre > 0.0 ? std::ceil(start) - start : start - std::floor(start));
    if (!(first_m > 0.0 && first_m < to_m)) return false;
    bool is_found = false;
    const Steps& steps = walk_->steps();
    walk_->over(ground, nullptr, first_m, step_m, static_cast<std::size_t>((to_m - first_m) / step_m) + 1,
                [&](std::size_t, std::size_t i) {
                  is_found = is_found || static_cast<double>(steps.slope[i]) > slope_ + slope_doubt;
                });
    return is_found;
  }

  static constexpr double places_a_cell = 2.0;

  const HorizonGrid& grid_;
  Vec3d radar_;
  const Occluders& occluders_;
  double across_, slope_;
  const float *left_, *right_;
  std::optional<Walk> walk_;
};

bool HorizonMap::rises_between(double across, double distance_m, double slope, Vec3d radar,
                               const Occluders& occluders) const {
  Crests crests(*this, across, slope, radar, occluders);
  return crests.lie_within(grid_.node_before(distance_m), distance_m) || crests.lie_before(distance_m);
}

}  // namespace sigmascape::live
