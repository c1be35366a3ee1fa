#include "sigmascape/receiver/pattern_gain.h"

#include <cmath>
#include <utility>

#include "sigmascape/base/units.h"

namespace sigmascape::receiver {

VoltageGain pattern_gain(const radar::Radar& radar, BeamAzimuth beam) {
  return [pattern = radar::antenna_pattern(radar), beam = std::move(beam)](const radar::Pulse& pulse, Vec3d position,
                                                                           double) {
    const Vec3d away = position - pulse.platform.position;
    const double offset = beam ? std::remainder(azimuth_of(away) - beam(pulse), 2.0 * pi) : 0.0;
    const double one_way = pattern.voltage(offset, std::asin(away.z / length(away)));
    return static_cast<float>(one_way * one_way / pattern.peak_gain());
  };
}

}  // namespace sigmascape::receiver
