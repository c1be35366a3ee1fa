#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "sigmascape/radar/ground_grid.h"
#include "sigmascape/radar/radar.h"
#include "sigmascape/radar/target.h"
#include "sigmascape/scene/scene.h"
#include "sigmascape/simulate/part_seen.h"
#include "sigmascape/trace/scene_geometry.h"

namespace sigmascape::simulate {

/// What of its targets a map or a recording shows.
struct TargetsSeen {
  std::size_t count = 0;  ///< of those that stand in the area and of which something is seen
  /// What whoever maps them should know, one sentence each: that none stands in the area, which of those that do are
  /// hidden, and which crowns weaken by 1 dB or more.
  std::vector<std::string> warnings;
};

/// Of an area that is mapped from terrain and an atlas, each target from where and when the radar looks at it.
[[nodiscard]] TargetsSeen targets_seen(std::span<const radar::Target> targets, const radar::Radar& radar,
                                       const radar::Rectangle& area, const Surroundings& surroundings);

/// Of a traced map: the targets of the scene and these.
[[nodiscard]] TargetsSeen targets_seen(const scene::Scene& scene, const trace::SceneGeometry& geometry,
                                       std::span<const radar::Target> targets, const radar::Radar& radar,
                                       const radar::Rectangle& area);

/// "a, b and c", of more than four "a, b, c and 4 more".
[[nodiscard]] std::string names_of(std::span<const radar::Target* const> targets);

}  // namespace sigmascape::simulate
