#include "sigmascape/live/kept_ground.h"

#include <algorithm>
#include <utility>

#include "sigmascape/live/frame_reach.h"
#include "sigmascape/live/ground_along.h"
#include "sigmascape/live/ground_hearing.h"
#include "sigmascape/radar/rectangle_parts.h"

namespace sigmascape::live {
namespace {

constexpr std::size_t most_nodes_a_side = 2048;
/// Of the farthest range, on every side of what the bins look at.
constexpr double margin_part = 0.25;

}  // namespace

KeptGround::View KeptGround::view_of(const radar::RangeAzimuthGrid& grid, Vec2d radar,
                                     const radar::CurvedEarth& earth) {
  const double far_m = farthest_ground_m(earth, last_range_m(grid));
  const double width_rad = static_cast<double>(grid.azimuths) * grid.azimuth_step_rad;
  const double margin_m = margin_part * far_m;
  // As of a whole turn, so that a sector that turns keeps its level; a few nodes more lie at the edges.
  const double node_m =
      std::max(grid.range_step_m, 2.0 * (far_m + margin_m) / static_cast<double>(most_nodes_a_side - 4));
  return {ground_under(radar, grid.first_azimuth_rad, width_rad, {0.0, far_m}), margin_m, node_m};
}

bool KeptGround::covers(const View& view) const {
  return window_ != nullptr && view.node_m == node_m_ && radar::holds(covered_, view.seen);
}

bool KeptGround::covers(const radar::RangeAzimuthGrid& grid, Vec2d radar, const radar::CurvedEarth& earth) const {
  return ground_ == nullptr || covers(view_of(grid, radar, earth));
}

void KeptGround::cover(const radar::RangeAzimuthGrid& grid, Vec2d radar, const radar::CurvedEarth& earth) {
  if (ground_ == nullptr) return;
  const View view = view_of(grid, radar, earth);
  if (covers(view) && !is_out_of_date()) return;
  const bool lacked_tiles = window_ != nullptr && window_->shortage;
  const radar::Rectangle wanted = radar::widened(view.seen, view.margin_m);
  const LiveTerrain& terrain = std::as_const(*ground_).terrain();
  window_ = std::make_shared<const LiveTerrain::Window>(terrain.window_over(wanted, view.node_m, most_nodes_a_side));
  view_ = window_->nodes.view();
  try_again_at_ = std::chrono::steady_clock::now() + terrain.pyramid().patience();
  covered_ = wanted;
  node_m_ = view.node_m;
  ++windows_;
  if (lacked_tiles) first_better_window_ = windows_;
}

bool KeptGround::is_out_of_date() {
  const auto now = std::chrono::steady_clock::now();
  if (!window_->shortage || now < try_again_at_) return false;
  if (window_->shortage()) return true;
  try_again_at_ = std::chrono::steady_clock::now() + ground_->terrain().pyramid().patience();
  return false;
}

}  // namespace sigmascape::live
