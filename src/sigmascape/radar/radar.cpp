#include "sigmascape/radar/radar.h"

#include <cmath>

#include "sigmascape/radar/look.h"

namespace sigmascape::radar {

AntennaPattern antenna_pattern(const Radar& radar) {
  return {radar.antenna, radar.beam_width_rad};
}

Vec3d position_seeing(Vec3d target, double azimuth_rad, double elevation_rad, double slant_range_m,
                      const CurvedEarth& earth) {
  const Vec3d line = direction_to_radar({azimuth_rad, elevation_rad}) * slant_range_m;
  const double c = earth.curvature_per_m();
  if (c == 0.0) return target + line;
  // In the triangle of the Earth's centre, the target and the radar, with its sides as they exceed 1/c.
  const double level_m = std::hypot(line.x, line.y), up = 1.0 + c * (target.z + line.z);
  const double excess = 2.0 * (target.z + line.z) + c * ((target.z + line.z) * (target.z + line.z) + level_m * level_m);
  const double height_m = excess / (1.0 + std::hypot(up, c * level_m));
  const double distance_m = std::atan2(c * level_m, up) / c;
  const Vec2d towards = horizontal_direction(azimuth_rad);
  return {target.x + towards.x * distance_m, target.y + towards.y * distance_m, height_m};
}

CurvedEarth earth_of(const Radar& radar) {
  CurvedEarth earth = CurvedEarth::flat();
  if (radar.earth_refraction) earth.refraction = *radar.earth_refraction;
  return earth;
}

}  // namespace sigmascape::radar
