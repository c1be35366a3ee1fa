#include "sigmascape/render/kept_ground.h"

#include <algorithm>

#include "sigmascape/render/frame_reach.h"

namespace sigmascape::render {
namespace {

constexpr std::size_t most_nodes_a_side = 2048;
/// Of the farthest range, on every side of what the bins look at.
constexpr double margin_part = 0.25;

bool contains(const radar::Rectangle& outer, const radar::Rectangle& inner) {
  return outer.west_m <= inner.west_m && outer.south_m <= inner.south_m && inner.east_m <= outer.east_m &&
         inner.north_m <= outer.north_m;
}

}  // namespace

void KeptGround::cover(const radar::RangeAzimuthGrid& grid, Vec2d radar) {
  if (ground_ == nullptr) return;
  const double far_m = grid.first_range_m + static_cast<double>(grid.ranges) * grid.range_step_m;
  const double width_rad = static_cast<double>(grid.azimuths) * grid.azimuth_step_rad;
  const double margin_m = margin_part * far_m;
  // As of a whole turn, so that a sector that turns keeps its level; a few nodes more lie at the edges.
  const double node_m =
      std::max(grid.range_step_m, 2.0 * (far_m + margin_m) / static_cast<double>(most_nodes_a_side - 4));
  const radar::Rectangle seen = ground_under(radar, grid.first_azimuth_rad, width_rad, {0.0, far_m});
  if (window_ != nullptr && node_m == node_m_ && contains(covered_, seen)) return;
  const radar::Rectangle wanted{seen.west_m - margin_m, seen.south_m - margin_m, seen.east_m + margin_m,
                                seen.north_m + margin_m};
  window_ =
      std::make_shared<const terrain::TerrainWindow>(ground_->terrain().window_over(wanted, node_m, most_nodes_a_side));
  view_ = window_->view();
  covered_ = wanted;
  node_m_ = node_m;
  ++windows_;
}

}  // namespace sigmascape::render
