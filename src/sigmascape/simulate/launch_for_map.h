#pragma once

#include <vector>

#include "sigmascape/simulate/simulate.h"
#include "sigmascape/trace/launch.h"

namespace sigmascape::simulate {

/// How far outside the area paths of several bounces may begin that land in it.
inline constexpr double multibounce_margin_m = 32.0;

/// From where rays go out for a map of `area`: the same for all passes over it. Throws Error for a radar that does not
/// stand above the scene.
[[nodiscard]] trace::LaunchArea launch_for_map(const scene::Scene& scene, const trace::SceneGeometry& geometry,
                                               const radar::Radar& radar, const radar::Rectangle& area, double cell_m);

/// As the function of that name for an area, which is the launch's target.
[[nodiscard]] std::vector<radar::RangeAzimuthImage> traced_bounces(
    const scene::Scene& scene, const trace::SceneGeometry& geometry, const radar::Radar& radar,
    const trace::LaunchArea& launch, const TraceSettings& settings, std::size_t orders, trace::TraceCounts& counts,
    ProgressListener* progress = nullptr);

}  // namespace sigmascape::simulate
