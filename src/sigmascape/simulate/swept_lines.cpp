#include "sigmascape/simulate/swept_lines.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "sigmascape/base/units.h"
#include "sigmascape/radar/azimuth_span.h"
#include "sigmascape/radar/look.h"
#include "sigmascape/radar/rectangle_distances.h"

namespace sigmascape::simulate {
namespace {

constexpr double steps_per_cell = 2.0;

/// From a platform at this height: beyond the far end of the map things matter as far as they can lie over it, at its
/// range or nearer.
std::size_t steps_over(const CoarseGround& ground, double platform_m, double near_m, double far_m, double terrain_end_m,
                       double step_m) {
  const double below_m = platform_m - static_cast<double>(ground.terrain->highest_m());
  const double above_m = platform_m - static_cast<double>(ground.terrain->lowest_m());
  const double last_range_m = std::hypot(far_m, above_m) + step_m;
  const double below_tops_m = std::max(0.0, below_m - ground.tallest_m);
  const double end_m = std::sqrt(last_range_m * last_range_m - below_tops_m * below_tops_m);
  return static_cast<std::size_t>(std::ceil((std::min(terrain_end_m, end_m) - near_m) / step_m)) + 1;
}

/// Of which none is wider than half a square of what stands on the ground, or than the terrain's spacing.
std::size_t strides_in(double step_m, const CoarseGround& ground) {
  double widest_m = ground.terrain->spacing_m;
  if (ground.obstacles != nullptr) widest_m = std::min(widest_m, 0.5 * ground.obstacles->grid.cell_m);
  return 2 * static_cast<std::size_t>(std::ceil(0.5 * (step_m / widest_m - 1.0) - 1e-9)) + 1;
}

SweptLines lines_about(const CoarseGround& ground, Vec3d platform, const radar::GroundGrid& grid) {
  const Vec2d here{platform.x, platform.y};
  const radar::Rectangle area = grid.extent(), all = ground.terrain->extent();
  const radar::AzimuthSpan azimuths = radar::azimuths_of(area, here);
  const double half_rad = std::max(-azimuths.left_rad, azimuths.right_rad);
  const double far_m = radar::farthest_m(area, here), step_m = grid.cell_m / steps_per_cell;
  const double turn_rad = step_m / far_m, first_rad = azimuths.middle_rad - half_rad;
  SweptLines swept{.lines = static_cast<std::size_t>(std::ceil(2.0 * half_rad / turn_rad)) + 1,
                   .near_m = radar::nearest_m(all, here),
                   .step_m = step_m,
                   .strides = strides_in(step_m, ground)};
  swept.steps = steps_over(ground, platform.z, swept.near_m, far_m, radar::farthest_m(all, here), step_m);
  swept.line = [=](std::size_t index) -> SweptLine {
    return {platform, radar::horizontal_direction(first_rad + static_cast<double>(index) * turn_rad)};
  };
  const double middle_rad = first_rad + 0.5 * static_cast<double>(swept.lines - 1) * turn_rad;
  swept.place_of = [=, near_m = swept.near_m](Vec2d point) -> Vec2d {
    const Vec2d away = point - here;
    const double azimuth_rad = middle_rad + turned_by_least(azimuth_of(away) - middle_rad);
    return {(length(away) - near_m) / step_m, (azimuth_rad - first_rad) / turn_rad};
  };
  swept.sees = [](Vec2d) { return true; };
  return swept;
}

/// None where the map lies behind the beam, on the other side of the track.
SweptLines lines_under(const CoarseGround& ground, const radar::PassingBeam& beam, const radar::GroundGrid& grid) {
  const radar::Rectangle area = grid.extent(), all = ground.terrain->extent();
  const auto distance_of = [&](Vec2d point) { return beam.distance_m(point); };
  const double far_m = radar::span_over(area, distance_of)[1], step_m = grid.cell_m / steps_per_cell;
  SweptLines swept{.step_m = step_m, .strides = strides_in(step_m, ground), .sees = [beam](Vec2d point) {
                     return beam.looks_to(point);
                   }};
  if (far_m < 0.0) return swept;
  const std::array<double, 2> across_m = radar::span_over(area, [&](Vec2d point) { return beam.across_m(point); });
  const std::array<double, 2> terrain_m = radar::span_over(all, distance_of);
  const auto platform_at = [beam](double across) { return beam.platform_at(beam.time_s(across)); };
  swept.lines = static_cast<std::size_t>(std::ceil((across_m[1] - across_m[0]) / step_m)) + 1;
  swept.near_m = std::max(0.0, terrain_m[0]);
  // A platform that climbs or rises over a round Earth is highest at an end.
  const double highest_m = std::max(platform_at(across_m[0]).z, platform_at(across_m[1]).z);
  swept.steps = steps_over(ground, highest_m, swept.near_m, far_m, terrain_m[1], step_m);
  swept.line = [=, first_m = across_m[0]](std::size_t index) -> SweptLine {
    return {platform_at(first_m + static_cast<double>(index) * step_m), beam.outwards};
  };
  swept.place_of = [=, near_m = swept.near_m, first_m = across_m[0]](Vec2d point) -> Vec2d {
    return {(beam.distance_m(point) - near_m) / step_m, (beam.across_m(point) - first_m) / step_m};
  };
  return swept;
}

}  // namespace

std::vector<SweptLines> swept_lines(const CoarseGround& ground, const radar::Vantage& vantage,
                                    const radar::GroundGrid& grid) {
  if (!vantage.beams()) return {lines_about(ground, vantage.place_for(grid.extent().centre()), grid)};
  return {lines_under(ground, vantage.beams()->front(), grid), lines_under(ground, vantage.beams()->back(), grid)};
}

}  // namespace sigmascape::simulate
