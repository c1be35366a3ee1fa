#include "sigmascape/bake/terrain_horizon.h"

#include <algorithm>
#include <cmath>

namespace sigmascape::bake {

TerrainHorizon::TerrainHorizon(const radar::Aspect& aspect, const terrain::HeightField& relief, double highest_m,
                               double step_m)
    : relief_(relief),
      step_(radar::horizontal_direction(aspect.azimuth_rad) * step_m),
      fall_m_(step_m * std::tan(aspect.elevation_rad)),
      highest_m_(highest_m),
      extent_(relief.extent()) {}

double TerrainHorizon::hidden_m(Vec2d place, double enough_m) const {
  const double ground_m = relief_.height_at(place);
  // Lines of sight rise towards the radar, so that terrain counts for less the farther it stands.
  double hidden_m = 0.0, sunk_m = fall_m_;
  for (Vec2d point = place + step_;
       hidden_m < enough_m && extent_.contains(point) && highest_m_ - sunk_m > ground_m + hidden_m;
       point = point + step_, sunk_m += fall_m_)
    hidden_m = std::max(hidden_m, relief_.height_at(point) - sunk_m - ground_m);
  return hidden_m;
}

}  // namespace sigmascape::bake
