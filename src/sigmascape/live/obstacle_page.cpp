#include "sigmascape/live/obstacle_page.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace sigmascape::live {
namespace {

std::uint16_t in_steps(float value, float per_unit) {
  constexpr auto most = static_cast<float>(std::numeric_limits<std::uint16_t>::max());
  return static_cast<std::uint16_t>(std::lround(std::clamp(value * per_unit, 0.0F, most)));
}

}  // namespace

PackedObstacle PackedObstacle::packed(const radar::Obstacle& obstacle) {
  return {in_steps(obstacle.solid_top_m, per_height_m), in_steps(obstacle.crown_base_m, per_height_m),
          in_steps(obstacle.crown_top_m, per_height_m), in_steps(obstacle.crown_extinction_per_m, per_extinction)};
}

}  // namespace sigmascape::live
