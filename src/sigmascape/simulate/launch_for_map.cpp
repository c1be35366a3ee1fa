#include "sigmascape/simulate/launch_for_map.h"

#include <algorithm>
#include <fmt/format.h>

#include "sigmascape/base/error.h"
#include "sigmascape/base/machine_memory.h"
#include "sigmascape/radar/radar_title.h"
#include "sigmascape/trace/rings_in_sight.h"

namespace sigmascape::simulate {
namespace {

/// Rays start this far above the highest point, and the radar must stand above their start.
constexpr double clearance_m = 1.0;

double start_height_m(const trace::SceneGeometry& geometry) {
  return geometry.highest_m() + clearance_m;
}

/// As many as cells are numbered with, and as memory has room for while rays that find nothing are spared: a list, one
/// that grew beyond it and one of what is kept.
double most_aimed_cells() {
  constexpr double most_numbered = 0x1p30, lists = 3.0;
  return std::min(most_numbered, machine_memory_bytes() / (lists * static_cast<double>(sizeof(trace::LaunchCell))));
}

void check_aim(const radar::Radar& radar, double highest_m, double cells) {
  if (const double most = most_aimed_cells(); cells > most) {
    throw Error(
        radar::title_of(radar),
        fmt::format("stands {:.3g} m above the highest point of the scene, and of the ground that answers in the "
                    "map's cells, what its beam takes in beside them and what lies behind tall objects included, "
                    "{:.2g} cells are to be aimed at",
                    radar.position.z - highest_m, cells),
        fmt::format("map larger cells or less ground, with a narrower beam or from higher up, for at most {:.2g}",
                    most));
  }
}

double cells_of(const trace::LaunchArea& outline) {
  return trace::aimed_area_m2(outline) / (outline.cell_m * outline.cell_m);
}

}  // namespace

bool stands_above(double radar_m, double highest_m) {
  return radar_m > highest_m + clearance_m;
}

void check_above(const radar::Radar& radar, double highest_m) {
  if (!stands_above(radar.position.z, highest_m)) {
    throw Error(
        radar::title_of(radar),
        fmt::format("stands at {:.1f} m, and the highest point of the scene at {:.1f} m", radar.position.z, highest_m),
        "place the radar above the scene, by more than a metre");
  }
}

double aimed_cells(const scene::Scene& scene, const trace::SceneGeometry& geometry, const trace::Viewpoint& viewpoint,
                   const radar::Rectangle& area, double cell_m, const trace::MultibounceReach& reach, double enough) {
  auto outline = trace::launch_outline(viewpoint, area, cell_m, geometry.lowest_m(), start_height_m(geometry), reach);
  if (const double cells = cells_of(outline); cells <= enough) return cells;
  outline.highest_m = trace::RingsInSight(outline, scene, geometry.footing()).highest_m();
  return cells_of(outline);
}

trace::LaunchArea launch_for_map(const scene::Scene& scene, const trace::SceneGeometry& geometry,
                                 const radar::Radar& radar, const radar::Rectangle& area, double cell_m) {
  check_above(radar, geometry.highest_m());
  const auto viewpoint = trace::Viewpoint::located(radar.position);
  const trace::MultibounceReach reach = trace::multibounce_reach(scene, viewpoint, area);
  auto launch = trace::launch_outline(viewpoint, area, cell_m, geometry.lowest_m(), start_height_m(geometry), reach);
  const trace::RingsInSight sight(launch, scene, geometry.footing());
  // A hill far away is not met where paths begin that count.
  launch.highest_m = sight.highest_m();
  check_aim(radar, geometry.highest_m(), cells_of(launch));
  trace::list_cells(launch);
  trace::spare_rays(launch, sight);
  return launch;
}

}  // namespace sigmascape::simulate
