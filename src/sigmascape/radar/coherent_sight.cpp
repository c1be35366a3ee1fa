#include "sigmascape/radar/coherent_sight.h"

#include <algorithm>
#include <cmath>

#include "sigmascape/base/units.h"
#include "sigmascape/radar/doppler.h"
#include "sigmascape/radar/window_response.h"

namespace sigmascape::radar {

CoherentSight coherent_sight(const Radar& radar, Vec3d away) {
  return {away, length(away), std::hypot(away.x, away.y), off_course_rad(radar.velocity_mps, away),
          std::hypot(radar.velocity_mps.x, radar.velocity_mps.y)};
}

double off_the_line_rad(double off_course_rad) {
  return std::min(off_course_rad, pi - off_course_rad);
}

bool beam_straddles_course(const Radar& radar, const CoherentSight& sight) {
  return off_the_line_rad(sight.off_course_rad) < radar.beam_width_rad / 2.0;
}

double cells_of_width(const Radar& radar) {
  return WindowResponse(radar.waveform.window).half_power_width() * radar.processing.looks;
}

double resolution_in_a_second_m(const Radar& radar, const CoherentSight& sight) {
  return cells_of_width(radar) * cross_range_resolution_m(sight.range_m, wavelength_m(radar.frequency_hz),
                                                          sight.horizontal_speed_mps, 1.0, sight.off_course_rad);
}

}  // namespace sigmascape::radar
