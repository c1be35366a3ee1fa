#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>

#include "sigmascape/base/vec.h"
#include "sigmascape/live/horizon_grid.h"
#include "sigmascape/live/horizon_lead.h"
#include "sigmascape/live/horizon_map.h"
#include "sigmascape/live/horizon_steps.h"
#include "sigmascape/live/horizon_walk.h"
#include "sigmascape/live/occluders.h"
#include "sigmascape/terrain/terrain_view.h"

namespace sigmascape::live {
namespace {

/// Looks for ground between the nodes that hides one point.
class HorizonCrests {
 public:
  HorizonCrests(const HorizonMap& map, double across, double slope, Vec3d radar, const Occluders& occluders)
      : grid_(map.grid()), radar_(radar), occluders_(occluders), across_(across), slope_(slope) {
    const auto left = static_cast<std::size_t>(std::min(across, static_cast<double>(grid_.azimuths - 2)));
    left_ = map.slopes(left);
    right_ = map.slopes(left + 1);
  }

  /// Between the first node, or the point if it lies before it, and the radar.
  bool lie_before(double distance_m) {
    const LeadSteps lead = lead_of(grid_, radar_, occluders_);
    const double from_m = lead.from_m - 0.5 * lead.step_m, to_m = std::min(grid_.near_m, distance_m);
    return lead.count > 0 && can_miss(occluders_.ground_before(), lead.step_m) &&
           !is_clear(occluders_.ground_before(), 0, from_m, to_m, 0.5 * lead.step_m) &&
           rise_from(occluders_.ground_before(), from_m, to_m);
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
    const HorizonSteps& steps = walk_->steps();
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
  std::optional<HorizonWalk> walk_;
};

}  // namespace

bool HorizonMap::rises_between(double across, double distance_m, double slope, Vec3d radar,
                               const Occluders& occluders) const {
  HorizonCrests crests(*this, across, slope, radar, occluders);
  return crests.lie_within(grid_.node_before(distance_m), distance_m) || crests.lie_before(distance_m);
}

}  // namespace sigmascape::live
