#include "sigmascape/trace/launch_lanes.h"

#include "sigmascape/base/vector_targets.h"

namespace sigmascape::trace {

SIGMASCAPE_VECTOR_TARGETS [[gnu::flatten]] void aim_rays(const Viewpoint& viewpoint, const LaunchSpace& space,
                                                         const AimLanes& aims, LaunchedLanes& launched) {
  const Viewpoint radar = viewpoint;
  const LaunchSpace from = space;
  for (std::size_t lane = 0; lane < lane_count; ++lane) {
    const Vec3d aim{(aims.i[lane] + static_cast<double>(aims.within_cell.x[lane])) * from.cell_m,
                    (aims.j[lane] + static_cast<double>(aims.within_cell.y[lane])) * from.cell_m, from.plane_height_m};
    const Vec3d to_radar = radar.direction_from(aim);
    const double back = (from.top_height_m - from.plane_height_m) / to_radar.z;
    launched.start.set(lane, (aim + to_radar * back - from.origin).to<float>());
    launched.direction.set(lane, (-to_radar).to<float>());
    launched.beam[lane] = radar.beam_of(aim, from.cell_m * from.cell_m);
  }
}

}  // namespace sigmascape::trace
