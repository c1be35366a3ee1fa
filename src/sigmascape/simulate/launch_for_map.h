#pragma once

#include "sigmascape/radar/radar.h"
#include "sigmascape/scene/scene.h"
#include "sigmascape/trace/launch.h"

namespace sigmascape::simulate {

/// Whether a radar at a height stands above where rays over a scene of that highest point start.
[[nodiscard]] bool stands_above(double radar_m, double highest_m);

/// Throws Error for a radar that does not stand above what is so high.
void check_above(const radar::Radar& radar, double highest_m);

/// How many cells trace::aimed_area_m2 holds for a map of `area`: they grow without end where the radar stands hardly
/// above the highest that such a map meets. It must stand above the scene. What the map meets is looked for only where
/// more than `enough` would lie below the highest point of the scene.
[[nodiscard]] double aimed_cells(const scene::Scene& scene, const trace::SceneGeometry& geometry,
                                 const trace::Viewpoint& viewpoint, const radar::Rectangle& area, double cell_m,
                                 const trace::MultibounceReach& reach, double enough);

/// From where rays go out for a map of `area`: the same for all passes over it. Throws Error for a radar that does not
/// stand above the scene, and for one so little above it that a list of the cells to aim at would be endless.
[[nodiscard]] trace::LaunchArea launch_for_map(const scene::Scene& scene, const trace::SceneGeometry& geometry,
                                               const radar::Radar& radar, const radar::Rectangle& area, double cell_m);

}  // namespace sigmascape::simulate
