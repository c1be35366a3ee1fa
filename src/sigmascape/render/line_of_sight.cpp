#include "sigmascape/render/line_of_sight.h"

#include <cmath>

namespace sigmascape::render {

bool line_of_sight(const terrain::HeightField& terrain, double highest_m, Vec3d radar, Vec3d point,
                   const radar::CurvedEarth& earth) {
  const Vec3d way = radar - point;
  const double distance_m = std::hypot(way.x, way.y);
  if (distance_m == 0.0) return true;
  const double rise = way.z / distance_m;
  const Vec2d direction{way.x / distance_m, way.y / distance_m};
  for (double d = terrain.spacing_m; d < distance_m; d += terrain.spacing_m) {
    // Between two points of the sea a straight line runs below it.
    const double height_m = point.z + d * rise - 0.5 * earth.curvature_per_m() * d * (distance_m - d);
    if (height_m > highest_m && earth.curvature_per_m() == 0.0) return true;
    const Vec2d under = Vec2d{point.x, point.y} + direction * d;
    if (!terrain.extent().contains(under)) return true;
    if (terrain.height_at(under) > height_m) return false;
  }
  return true;
}

}  // namespace sigmascape::render
