#include "sigmascape/render/line_of_sight.h"

#include "sigmascape/radar/sea_horizon.h"
#include "sigmascape/radar/straight_sight.h"

namespace sigmascape::render {

bool line_of_sight(const terrain::HeightField& terrain, double lowest_m, double highest_m, Vec3d radar, Vec3d point,
                   const radar::CurvedEarth& earth) {
  const radar::StraightSight sight(point, radar, earth);
  const radar::SeaHorizon sea(radar.z, lowest_m, earth.curvature_per_m());
  if (sight.slope_from_radar() < sea.slope_before(sight.length_m)) return false;
  for (double d = terrain.spacing_m; d < sight.length_m; d += terrain.spacing_m) {
    const double height_m = sight.height_at(d);
    if (height_m > highest_m && earth.curvature_per_m() == 0.0) return true;
    const Vec2d under = sight.place_at(d);
    if (!terrain.extent().contains(under)) return true;
    if (terrain.height_at(under) > height_m) return false;
  }
  return true;
}

}  // namespace sigmascape::render
