#include "sigmascape/simulate/launch_for_map.h"

#include <fmt/format.h>

#include "sigmascape/base/error.h"
#include "sigmascape/radar/radar_title.h"

namespace sigmascape::simulate {
namespace {

/// Rays start this far above the highest point, and the radar must stand above their start.
constexpr double clearance_m = 1.0;

}  // namespace

bool stands_above(double radar_m, double highest_m) {
  return radar_m > highest_m + clearance_m;
}

void check_above(const radar::Radar& radar, double highest_m) {
  if (!stands_above(radar.position.z, highest_m)) {
    throw Error(radar::title_of(radar),
                fmt::format("stands at {:.0f} m, below the highest point of the scene at {:.0f} m", radar.position.z,
                            highest_m),
                "place the radar above the scene");
  }
}

trace::LaunchArea launch_for_map(const scene::Scene& scene, const trace::SceneGeometry& geometry,
                                 const radar::Radar& radar, const radar::Rectangle& area, double cell_m) {
  check_above(radar, geometry.highest_m());
  const auto viewpoint = trace::Viewpoint::located(radar.position);
  auto launch = trace::launch_area(viewpoint, area, cell_m, geometry.lowest_m(), geometry.highest_m() + clearance_m,
                                   trace::multibounce_reach(scene, viewpoint, area));
  trace::spare_rays(launch, scene, geometry.footing());
  return launch;
}

}  // namespace sigmascape::simulate
