#include "sigmascape/radar/radar.h"

#include "sigmascape/radar/look.h"

namespace sigmascape::radar {

AntennaPattern antenna_pattern(const Radar& radar) {
  return {radar.antenna, radar.beam_width_rad};
}

Vec3d position_seeing(Vec3d target, double azimuth_rad, double elevation_rad, double slant_range_m) {
  return target + direction_to_radar({azimuth_rad, elevation_rad}) * slant_range_m;
}

CurvedEarth earth_of(const Radar& radar) {
  CurvedEarth earth = CurvedEarth::flat();
  if (radar.earth_refraction) earth.refraction = *radar.earth_refraction;
  return earth;
}

}  // namespace sigmascape::radar
