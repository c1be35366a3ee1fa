#pragma once

#include <span>
#include <vector>

#include "sigmascape/base/vec.h"
#include "sigmascape/radar/echo.h"
#include "sigmascape/radar/target_shadows.h"

namespace sigmascape::simulate {

/// Where a direct echo comes from; for one of several bounces where it seems to stand.
[[nodiscard]] Vec3d place_of(const radar::Echo& echo, Vec3d radar_position);

/// The echoes that no target's box keeps from the radar. One of several bounces is judged by where it seems to stand.
class UnhiddenEchoes {
 public:
  UnhiddenEchoes(std::span<const radar::Target> targets, Vec3d radar_position, unsigned workers, double time_s = 0.0);

  /// Valid until the same worker asks again.
  [[nodiscard]] std::span<const radar::Echo> among(std::span<const radar::Echo> echoes, unsigned worker);

 private:
  radar::TargetShadows shadows_;
  Vec3d radar_position_;
  std::vector<std::vector<radar::Echo>> kept_;
};

}  // namespace sigmascape::simulate
