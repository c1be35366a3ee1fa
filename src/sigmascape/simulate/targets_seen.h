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
  std::size_t count = 0;  ///< of those of which something is seen, in a map of those that stand in it
  /// What whoever maps them should know, one sentence each: that none stands in the map, which of those that do are
  /// hidden, and which crowns weaken by 1 dB or more.
  std::vector<std::string> warnings;
};

/// Of a map of an area from terrain and an atlas, each target from where and when the radar looks at it. `obstacles`:
/// of an atlas that keeps them apart, else null.
[[nodiscard]] TargetsSeen targets_in_map(std::span<const radar::Target> targets, const radar::Radar& radar,
                                         const radar::Rectangle& area, const terrain::HeightField& terrain,
                                         const radar::ObstacleMap* obstacles);

/// Of pulses of it, which hold the echoes of targets wherever they stand.
[[nodiscard]] TargetsSeen targets_in_pulses(std::span<const radar::Target> targets, const radar::Radar& radar,
                                            const radar::Rectangle& area, const terrain::HeightField& terrain,
                                            const radar::ObstacleMap* obstacles);

/// Of a traced map: the targets of the scene and these.
[[nodiscard]] TargetsSeen targets_in_traced(const scene::Scene& scene, const trace::SceneGeometry& geometry,
                                            std::span<const radar::Target> targets, const radar::Radar& radar,
                                            const radar::Rectangle& area);

/// "a, b and c", of more than four "a, b, c and 4 more".
[[nodiscard]] std::string names_of(std::span<const radar::Target* const> targets);

}  // namespace sigmascape::simulate
