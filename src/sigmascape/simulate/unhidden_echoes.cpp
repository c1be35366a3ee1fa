#include "sigmascape/simulate/unhidden_echoes.h"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace sigmascape::simulate {

Vec3d place_of(const radar::Echo& echo, Vec3d radar_position) {
  const auto down = static_cast<double>(echo.sin_depression);
  const double over_ground_m = echo.range_m * std::sqrt(std::max(0.0, 1.0 - down * down));
  return radar_position +
         Vec3d{over_ground_m * std::sin(echo.cross), over_ground_m * std::cos(echo.cross), -echo.range_m * down};
}

UnhiddenEchoes::UnhiddenEchoes(const radar::Rectangle& extent, std::span<const radar::Target> targets,
                               Vec3d radar_position, unsigned workers, double time_s)
    : extent_(extent), shadows_(targets, time_s, radar_position), radar_position_(radar_position), kept_(workers) {}

bool UnhiddenEchoes::is_left_out(const radar::Echo& echo) const {
  if (shadows_.empty() && !echo.from_ground) return false;
  const Vec3d place = place_of(echo, radar_position_);
  return (echo.from_ground && !extent_.contains({place.x, place.y})) || shadows_.hide(place);
}

std::span<const radar::Echo> UnhiddenEchoes::among(std::span<const radar::Echo> echoes, unsigned worker) {
  const auto first = std::ranges::find_if(echoes, [&](const radar::Echo& echo) { return is_left_out(echo); });
  if (first == echoes.end()) return echoes;
  std::vector<radar::Echo>& kept = kept_[worker];
  kept.assign(echoes.begin(), first);
  std::copy_if(first + 1, echoes.end(), std::back_inserter(kept),
               [&](const radar::Echo& echo) { return !is_left_out(echo); });
  return kept;
}

}  // namespace sigmascape::simulate
