#include "sigmascape/receiver/target_echoes.h"

#include <cmath>

namespace sigmascape::receiver {

std::vector<radar::Echo> target_echoes(std::span<const radar::Target> targets, const radar::Radar& radar,
                                       const radar::Moment& moment) {
  std::vector<radar::Echo> echoes;
  echoes.reserve(targets.size());
  for (const radar::Target& target : targets) {
    const Vec3d away = target.track.position_at(moment.time_s) - radar.position;
    const double range_m = length(away);
    echoes.push_back({.range_m = range_m,
                      .cross = std::atan2(away.x, away.y),
                      .rcs_m2 = radar::rcs_of(target, radar.position, radar.frequency_hz, moment),
                      .bounces = 1,
                      .sin_depression = static_cast<float>(-away.z / range_m)});
  }
  return echoes;
}

std::vector<radar::Scatterer> target_scatterers(std::span<const radar::Target> targets, const radar::Radar& radar,
                                                const radar::Moment& moment) {
  std::vector<radar::Scatterer> scatterers;
  scatterers.reserve(targets.size());
  for (const radar::Target& target : targets) {
    const radar::Channels rcs = radar::rcs_of(target, radar.position, radar.frequency_hz, moment);
    scatterers.push_back({target.track.position_at(moment.time_s), radar::steady_amplitude(rcs)});
  }
  return scatterers;
}

}  // namespace sigmascape::receiver
