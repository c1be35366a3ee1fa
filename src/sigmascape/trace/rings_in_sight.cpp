#include "sigmascape/trace/rings_in_sight.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "sigmascape/radar/ground_stretch.h"
#include "sigmascape/radar/rectangle_parts.h"

namespace sigmascape::trace {
namespace {

constexpr double least_square_m = 16.0;
/// Single precision moves vertices by less than this.
constexpr double rounding_m = 1.0;
/// From where on the heights that a ray has over a square of the bounds tell less than what stands there.
constexpr double steep = 20.0;
/// Of a direction that points straight up.
constexpr double least_horizontal = 1e-12;

}  // namespace

RingsInSight::RingsInSight(const LaunchArea& area, const scene::Scene& scene, Footing footing)
    : area_(area),
      reach_m_(std::numbers::sqrt2 / 2.0 * area.grain_m()),
      region_(region()),
      bounds_(scene, footing, region_, std::max(least_square_m, 2.0 * reach_m_)) {}

double RingsInSight::highest_m() const {
  return std::min(area_.top_height_m, static_cast<double>(bounds_.highest_m()) + rounding_m);
}

std::optional<std::size_t> RingsInSight::innermost(Vec2d centre) const {
  const Vec3d to_radar = area_.viewpoint.direction_from({centre.x, centre.y, area_.plane_height_m});
  const double horizontal = std::max(std::sqrt(to_radar.x * to_radar.x + to_radar.y * to_radar.y), least_horizontal);
  const double slope = to_radar.z / horizontal;
  // Squares reach as far as `reach_m_` about their centres, and a step stands for half its length before and after:
  // both together are less than a square of the bounds, as far as one speaks for. Rays of a square rise nearly alike.
  const double step_m = 0.5 * bounds_.square_m(), slack_m = (0.5 * step_m + 3.0 * reach_m_) * slope + rounding_m;
  const Vec2d towards{to_radar.x / horizontal, to_radar.y / horizontal};
  const double until_m = (static_cast<double>(bounds_.highest_m()) + slack_m - area_.plane_height_m) / slope;
  const radar::GroundStretch stretch = radar::stretch_within(region_, centre, towards);
  const double end_m = std::min(stretch.end_m, until_m);
  std::optional<std::size_t> innermost;
  for (double way = stretch.begin_m; way < end_m + step_m; way += step_m) {
    const Vec2d place = centre + towards * way;
    const CoarseHeights::Interval* heights = bounds_.around(place);
    if (heights == nullptr) continue;
    const double height = area_.plane_height_m + way * slope, highest = static_cast<double>(heights->highest_m);
    if (height - slack_m > highest || height + slack_m < static_cast<double>(heights->lowest_m)) continue;
    const double met_below_m = slope < steep ? height + slack_m : std::min(height + slack_m, highest);
    const double layover_m = area_.viewpoint.landing_before_m({place.x, place.y, met_below_m}, area_.plane_height_m);
    const std::size_t ring = ring_of(place, towards, layover_m, 0.5 * step_m + reach_m_);
    innermost = std::min(innermost.value_or(ring), ring);
    if (innermost == 0) break;
  }
  return innermost;
}

std::size_t RingsInSight::ring_of(Vec2d place, Vec2d towards, double layover_m, double about_m) const {
  std::size_t ring = 0;
  while (ring + 1 < area_.rings.size() && !area_.rings[ring].meets(place, towards, layover_m, about_m)) {
    ++ring;
  }
  return ring;
}

radar::Rectangle RingsInSight::region() const {
  const radar::Rectangle reached = widened(area_.rings.back().upright(), area_.counting_rim_m());
  const Vec2d nearest = area_.viewpoint.nearest_point(reached);
  const double behind_m =
      area_.viewpoint.point_behind_landing_m({nearest.x, nearest.y, area_.plane_height_m}, area_.top_height_m);
  return radar::widened(reached, behind_m + least_square_m + 2.0 * reach_m_);
}

}  // namespace sigmascape::trace
