#include "sigmascape/live/horizon_lead.h"

#include <algorithm>
#include <cmath>

namespace sigmascape::live {
namespace {

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

}  // namespace

LeadSteps lead_of(const HorizonGrid& grid, Vec3d radar, const Occluders& occluders) {
  return lead_of(grid, radar, occluders.bounds());
}

LeadSteps lead_of(const HorizonGrid& grid, Vec3d radar, const terrain::HeightBounds& bounds) {
  const double clear_m = nearest_occluder_m(grid, radar, bounds);
  const double step_m = std::max((grid.near_m - clear_m) / static_cast<double>(grid.before_near), grid.step_m);
  // Nothing lies between the radar and a map that begins below it, however short its steps.
  if (!(step_m > 0.0)) return {grid.near_m, grid.step_m, 0};
  const auto count = static_cast<std::size_t>((grid.near_m - clear_m) / step_m);
  return {grid.near_m - (static_cast<double>(count) - 0.5) * step_m, step_m, count};
}

}  // namespace sigmascape::live
