#include "sigmascape/bake/terrain_horizon.h"

#include <algorithm>
#include <cmath>

namespace sigmascape::bake {

TerrainHorizon::TerrainHorizon(const radar::Aspect& aspect, const terrain::HeightField& relief, double step_m)
    : relief_(relief),
      step_(radar::horizontal_direction(aspect.azimuth_rad) * step_m),
      fall_m_(step_m * std::tan(aspect.elevation_rad)),
      highest_m_(relief.highest_m()) {}

double TerrainHorizon::part_seen(Vec2d place, const radar::Obstacle& obstacle) const {
  const double ground_m = relief_.height_at(place), top_m = static_cast<double>(obstacle.top_m());
  // Lines of sight rise towards the radar, so that terrain counts for less the farther it stands.
  double hidden_m = 0.0, sunk_m = fall_m_;
  for (Vec2d point = place + step_; highest_m_ - sunk_m > ground_m + hidden_m; point = point + step_, sunk_m += fall_m_)
    hidden_m = std::max(hidden_m, relief_.height_at(point) - sunk_m - ground_m);
  if (hidden_m == 0.0) return 1.0;
  return hidden_m < top_m ? 1.0 - hidden_m / top_m : 0.0;
}

}  // namespace sigmascape::bake
