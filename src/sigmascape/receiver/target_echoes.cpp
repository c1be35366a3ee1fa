#include "sigmascape/receiver/target_echoes.h"

#include <algorithm>
#include <cmath>

#include "sigmascape/receiver/range_azimuth_receiver.h"

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

void add_echoes(radar::RangeAzimuthImage& image, const radar::Radar& radar, std::span<const radar::Echo> echoes) {
  if (echoes.empty()) return;
  double sum_m2 = 0.0;
  for (const radar::Echo& echo : echoes)
    sum_m2 += static_cast<double>(std::max({echo.rcs_m2.vv, echo.rcs_m2.hh, echo.rcs_m2.hv}));
  // A power of two, by which floats are multiplied exactly.
  constexpr double most_m2 = 0x1p24;
  const auto unit = sum_m2 > most_m2 ? static_cast<float>(std::exp2(std::ceil(std::log2(sum_m2 / most_m2)))) : 1.0F;
  std::vector<radar::Echo> fitting(echoes.begin(), echoes.end());
  for (radar::Echo& echo : fitting) echo.rcs_m2 = echo.rcs_m2 * (1.0F / unit);
  RangeAzimuthReceiver receiver(radar, image.grid);
  receiver.add(fitting);
  const radar::RangeAzimuthImage answers = receiver.image();
  for (std::size_t i = 0; i < image.rcs_m2.size(); ++i) image.rcs_m2.values()[i] += answers.rcs_m2.values()[i] * unit;
}

}  // namespace sigmascape::receiver
