#include "sigmascape/live/horizon_map.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>

#include "sigmascape/live/crown_depth.h"
#include "sigmascape/live/horizon_lead.h"
#include "sigmascape/live/horizon_steps.h"
#include "sigmascape/live/horizon_walk.h"
#include "sigmascape/live/lesser_greater.h"
#include "sigmascape/radar/look.h"
#include "sigmascape/radar/sea_horizon.h"
#include "sigmascape/terrain/obstacle_sweep.h"
#include "sigmascape/terrain/roof_doubt.h"

namespace sigmascape::live {
namespace {

/// What a line of sight must rise above, as far as a direction has been walked.
struct Horizon {
  float steepest = no_ground;  ///< of ground
  float solid = no_ground;     ///< of solid tops

  /// Goes over a step of `step_m`, the ground under it and what stands there, its crowns unless others have.
  void pass(const HorizonSteps& steps, std::size_t i, double step_m, CrownDepth* crowns) {
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

}  // namespace

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
  rise_to_sea(azimuth, radar, occluders);
}

void HorizonMap::rise_to_sea(std::size_t azimuth, Vec3d radar, const Occluders& occluders) {
  const radar::SeaHorizon sea(radar.z, static_cast<double>(occluders.bounds().lowest_m), 2.0 * grid_.drop_per_square_m);
  const double before = std::max((sea.distance_m() - grid_.near_m) / grid_.step_m, 0.0);
  if (!(before < static_cast<double>(grid_.distances))) return;
  const std::span<float> beyond =
      std::span(slopes(azimuth), grid_.distances).subspan(static_cast<std::size_t>(std::ceil(before)));
  const auto horizon = static_cast<float>(sea.slope_before(std::numeric_limits<double>::infinity()));
  for (float& slope : beyond) slope = greater(slope, horizon);
}

void HorizonMap::sweep_ground(std::size_t azimuth, Vec3d radar, const Occluders& occluders) {
  HorizonWalk walk(grid_, azimuth, radar, occluders);
  const HorizonSteps& steps = walk.steps();
  const LeadSteps lead = lead_of(grid_, radar, occluders);
  float steepest = no_ground;
  walk.over(occluders.ground_before(), nullptr, lead.from_m, lead.step_m, lead.count,
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

  HorizonWalk walk(grid_, azimuth, radar, occluders);
  const HorizonSteps& steps = walk.steps();
  const LeadSteps lead = lead_of(grid_, radar, occluders);
  Horizon horizon;
  const HorizonStrides to_near = HorizonStrides::to_near(lead, occluders);
  walk.over(occluders.ground_before(), &occluders.obstacles_before(), to_near.first_m, to_near.length_m,
            lead.count * to_near.a_step,
            [&](std::size_t, std::size_t i) { horizon.pass(steps, i, to_near.length_m, &crowns); });

  const HorizonStrides within = HorizonStrides::within(grid_, occluders);
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
  const double over_all_m = radar.z - static_cast<double>(occluders.bounds().highest_m);
  if (over_all_m > 0.0 && slope >= 0.0) return 1.0;
  const double clear_m = over_all_m > 0.0 ? over_all_m / -slope : 0.0;
  HorizonWalk walk(grid_, azimuth, radar, occluders);
  double depth = 0.0;
  const auto walk_through = [&](const terrain::TerrainView& ground, const ObstacleMosaic& obstacles,
                                const HorizonStrides& strides, std::size_t first, std::size_t end) {
    const auto left_out = static_cast<std::size_t>(std::clamp((clear_m - strides.first_m) / strides.length_m,
                                                              static_cast<double>(first), static_cast<double>(end)));
    walk.over(ground, &obstacles, strides.first_m + static_cast<double>(left_out) * strides.length_m, strides.length_m,
              end - left_out,
              [&](std::size_t, std::size_t i) { depth += walk.steps().crown_depth(i, strides.length_m, slope); });
  };
  const LeadSteps lead = lead_of(grid_, radar, occluders);
  const HorizonStrides to_near = HorizonStrides::to_near(lead, occluders),
                       within = HorizonStrides::within(grid_, occluders);
  walk_through(occluders.ground_before(), occluders.obstacles_before(), to_near, 0, lead.count * to_near.a_step);
  walk_through(occluders.terrain, *occluders.obstacles, within, within.passed(lead), (node + 1) * within.a_step);
  return std::exp(-depth);
}

double HorizonMap::through_beyond(std::size_t azimuth, std::size_t node, double distance_m, double slope, Vec3d radar,
                                  const Occluders& occluders) const {
  const HorizonStrides strides = HorizonStrides::within(grid_, occluders);
  const double node_m = grid_.near_m + static_cast<double>(node) * grid_.step_m;
  // A stride reaches half its length to either side of its middle, the node's as well.
  const double rest_m = distance_m - node_m - 0.5 * strides.length_m;
  if (!(rest_m > 0.0 && strides.length_m > 0.0)) return 1.0;
  HorizonWalk walk(grid_, azimuth, radar, occluders);
  double depth = 0.0;
  walk.over(occluders.terrain, occluders.obstacles, node_m + strides.length_m, strides.length_m,
            static_cast<std::size_t>(std::ceil(rest_m / strides.length_m)), [&](std::size_t number, std::size_t i) {
              const double part = std::min(rest_m / strides.length_m - static_cast<double>(number), 1.0);
              depth += part * walk.steps().crown_depth(i, strides.length_m, slope);
            });
  return std::exp(-depth);
}

bool HorizonMap::is_behind_solid(std::size_t azimuth, double distance_m, double slope, double roof_doubt_m, Vec3d radar,
                                 const Occluders& occluders) const {
  const HorizonStrides within = HorizonStrides::within(grid_, occluders);
  const double square_m = occluders.obstacles->grid().cell_m;
  // Up to there the nodes know it.
  const double known_m = roof_doubt_m > 0.0 ? distance_m - terrain::most_doubtful_squares * square_m : distance_m;
  const bool is_known = roof_doubt_m == 0.0 || known_m >= grid_.near_m;
  const std::size_t node = grid_.node_before(known_m);
  if (is_known && slope < static_cast<double>(solid_slopes(azimuth)[node])) return true;

  HorizonWalk walk(grid_, azimuth, radar, occluders);
  bool is_hidden = false;
  const auto pass = [&](std::size_t, std::size_t i) {
    const double at_m = static_cast<double>(walk.steps().distance_m[i]);
    const double left_m = terrain::doubt_left_m(roof_doubt_m, distance_m - at_m, -slope, square_m);
    is_hidden = is_hidden || slope < walk.steps().solid_slope(i) - left_m / at_m;
  };
  const std::size_t first = is_known ? (node + 1) * within.a_step : 0;
  if (!is_known) {
    const LeadSteps lead = lead_of(grid_, radar, occluders);
    const HorizonStrides to_near = HorizonStrides::to_near(lead, occluders);
    walk.over(occluders.ground_before(), &occluders.obstacles_before(), to_near.first_m, to_near.length_m,
              lead.count * to_near.a_step, pass);
  }
  const double first_m = within.first_m + static_cast<double>(first) * within.length_m;
  // Those whose middles lie before the point.
  if (!(within.length_m > 0.0 && distance_m >= first_m)) return is_hidden;
  walk.over(occluders.terrain, occluders.obstacles, first_m, within.length_m,
            static_cast<std::size_t>((distance_m - first_m) / within.length_m) + 1, pass);
  return is_hidden;
}

}  // namespace sigmascape::live
