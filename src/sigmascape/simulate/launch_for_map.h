#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "sigmascape/simulate/simulate.h"
#include "sigmascape/trace/launch.h"

namespace sigmascape::simulate {

/// From where rays go out for a map of `area`: the same for all passes over it. Throws Error for a radar that does not
/// stand above the scene.
[[nodiscard]] trace::LaunchArea launch_for_map(const scene::Scene& scene, const trace::SceneGeometry& geometry,
                                               const radar::Radar& radar, const radar::Rectangle& area, double cell_m);

/// Launch cells that all get so many rays, or LaunchCell::share of them. Shares of a map differ in nothing else than
/// their cells and rays.
struct LaunchShare {
  trace::LaunchArea launch;
  std::uint32_t samples_per_cell = 0;
  std::uint32_t one_in = 1;  ///< of so many cells only one gets its rays, by lot, and stands for as many
};

/// Is told what each ray brought, as though it stood for its whole cell: from several threads at once, told apart by
/// `worker`, but of one cell by one thread and in order.
using RayWatcher =
    std::function<void(const trace::LaunchCell& cell, std::span<const radar::Echo> echoes, unsigned worker)>;

/// As the function of that name for an area, which is the target of all the shares. `settings.samples_per_cell` has no
/// say.
[[nodiscard]] std::vector<radar::RangeAzimuthImage> traced_bounces(
    const scene::Scene& scene, const trace::SceneGeometry& geometry, const radar::Radar& radar,
    std::span<const LaunchShare> shares, const TraceSettings& settings, std::size_t orders, trace::TraceCounts& counts,
    ProgressListener* progress = nullptr, const RayWatcher& watcher = {});

}  // namespace sigmascape::simulate
