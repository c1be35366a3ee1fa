#include "sigmascape/bake/terrain_horizon.h"

#include <algorithm>
#include <cmath>

namespace sigmascape::bake {
namespace {

double steps_to_leave(double from, double step, double low, double high) {
  if (step == 0.0) return std::numeric_limits<double>::infinity();
  return std::max(((step > 0.0 ? high : low) - from) / step, 0.0);
}

}  // namespace

TerrainHorizon::TerrainHorizon(const radar::Aspect& aspect, const terrain::HeightField& relief,
                               const HighestGround& highest, double step_m)
    : relief_(relief),
      highest_(highest),
      step_(radar::horizontal_direction(aspect.azimuth_rad) * step_m),
      fall_m_(step_m * std::tan(aspect.elevation_rad)),
      highest_m_(highest.highest_m()),
      extent_(relief.extent()) {}

double TerrainHorizon::hidden_m(Vec2d place, double enough_m) const {
  const double ground_m = relief_.height_at(place);
  double hidden_m = 0.0, steps = 1.0;
  std::size_t level = 0;
  while (hidden_m < enough_m) {
    const Vec2d point = place + step_ * steps;
    // Lines of sight rise towards the radar, so that terrain counts for less the farther it stands: of a square for
    // most where the line comes in.
    const double needed_m = ground_m + hidden_m + fall_m_ * steps;
    if (!extent_.contains(point) || highest_m_ <= needed_m) break;
    const HighestGround::Square square = highest_.around(point, level);
    if (square.highest_m <= needed_m) {
      steps += steps_through(square.extent, point);
      level = std::min(level + 1, highest_.levels() - 1);
    } else if (level > 0) {
      --level;
    } else {
      hidden_m = std::max(hidden_m, relief_.height_at(point) - fall_m_ * steps - ground_m);
      steps += 1.0;
    }
  }
  return hidden_m;
}

double TerrainHorizon::steps_through(const radar::Rectangle& square, Vec2d point) const {
  return 1.0 + std::floor(std::min(steps_to_leave(point.x, step_.x, square.west_m, square.east_m),
                                   steps_to_leave(point.y, step_.y, square.south_m, square.north_m)));
}

}  // namespace sigmascape::bake
