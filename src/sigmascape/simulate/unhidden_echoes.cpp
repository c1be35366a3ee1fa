#include "sigmascape/simulate/unhidden_echoes.h"

#include <algorithm>
#include <cmath>

namespace sigmascape::simulate {

Vec3d place_of(const radar::Echo& echo, Vec3d radar_position) {
  const auto down = static_cast<double>(echo.sin_depression);
  const double over_ground_m = echo.range_m * std::sqrt(std::max(0.0, 1.0 - down * down));
  return radar_position +
         Vec3d{over_ground_m * std::sin(echo.cross), over_ground_m * std::cos(echo.cross), -echo.range_m * down};
}

UnhiddenEchoes::UnhiddenEchoes(std::span<const radar::Target> targets, Vec3d radar_position, unsigned workers,
                               double time_s)
    : shadows_(targets, time_s, radar_position), radar_position_(radar_position), kept_(workers) {}

std::span<const radar::Echo> UnhiddenEchoes::among(std::span<const radar::Echo> echoes, unsigned worker) {
  if (shadows_.empty()) return echoes;
  std::vector<radar::Echo>& kept = kept_[worker];
  kept.clear();
  for (const radar::Echo& echo : echoes) {
    if (!shadows_.hide(place_of(echo, radar_position_))) kept.push_back(echo);
  }
  return kept;
}

}  // namespace sigmascape::simulate
