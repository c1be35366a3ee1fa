#include "sigmascape/scatter/surface_sigma0.h"

#include <cmath>

#include "sigmascape/base/units.h"
#include "sigmascape/radar/look.h"

namespace sigmascape::scatter {

radar::Channels surface_sigma0(const SurfaceModel& surface, double grazing_rad) {
  const Vec3f to_radar = radar::direction_to_radar({0.0, grazing_rad}).to<float>();
  const double sine = std::sin(grazing_rad);
  return surface.backscatter(to_radar, {{0.0F, 0.0F, 1.0F}, 0.0F}) * static_cast<float>(4.0 * pi * sine * sine);
}

}  // namespace sigmascape::scatter
