#pragma once

#include <span>
#include <vector>

#include "sigmascape/base/vec.h"
#include "sigmascape/radar/echo.h"
#include "sigmascape/radar/ground_grid.h"
#include "sigmascape/radar/target_shadows.h"

namespace sigmascape::simulate {

/// Where a direct echo comes from; for one of several bounces where it seems to stand.
[[nodiscard]] Vec3d place_of(const radar::Echo& echo, Vec3d radar_position);

/// The echoes of a scene that no target's box keeps from the radar. One of several bounces is judged by where it seems
/// to stand. The ground that carries the terrain on beyond the scene's extent (trace::SceneGeometry) is there for walls
/// to stand before: it reflects onto them, but sends nothing back of its own.
class UnhiddenEchoes {
 public:
  UnhiddenEchoes(const radar::Rectangle& extent, std::span<const radar::Target> targets, Vec3d radar_position,
                 unsigned workers, double time_s = 0.0);

  /// Valid until the same worker asks again.
  [[nodiscard]] std::span<const radar::Echo> among(std::span<const radar::Echo> echoes, unsigned worker);

 private:
  [[nodiscard]] bool is_left_out(const radar::Echo& echo) const;

  radar::Rectangle extent_;
  radar::TargetShadows shadows_;
  Vec3d radar_position_;
  std::vector<std::vector<radar::Echo>> kept_;
};

}  // namespace sigmascape::simulate
