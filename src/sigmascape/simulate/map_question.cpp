#include "sigmascape/simulate/map_question.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "sigmascape/atlas/ground_layers.h"
#include "sigmascape/radar/coherent_plan.h"
#include "sigmascape/radar/strip_beam.h"
#include "sigmascape/scene/mesh_counts.h"

namespace sigmascape::simulate {

render::DetailQuestion map_question(const scene::Scene& scene, const radar::Radar& radar, const radar::GroundGrid& grid,
                                    const atlas::Store* store) {
  const Vec2d centre = grid.extent().centre();
  const Vec3d aim{centre.x, centre.y, scene.terrain.height_at(centre)};
  const Vec3d away = radar::as_it_passes(radar, aim).position - aim;
  const bool real_beam = radar.mode == radar::Mode::RealBeam;
  // From above the middle a beam is as wide as halfway to the corners.
  const double distance_m =
      std::max(std::hypot(away.x, away.y), 0.25 * std::hypot(grid.extent().width_m(), grid.extent().height_m()));
  render::DetailQuestion question;
  question.range_resolution_m = radar.range_resolution_m;
  question.cross_range_m =
      real_beam ? radar.beam_width_rad * distance_m : radar::coherent_plan(radar, aim).along_resolution_m;
  question.grazing_rad = std::asin(away.z / length(away));
  question.tallest_object_m = scene::tallest_object_m(scene);
  question.triangles_per_m2 = scene::triangles_per_m2(scene);
  question.area_m2 = grid.extent().width_m() * grid.extent().height_m();
  question.traceable = real_beam;
  // Maps stand on the scene's own terrain at every level of detail.
  question.terrain_spacing_m = scene.terrain.spacing_m;
  question.texel_m = grid.cell_m;
  if (store != nullptr) {
    const atlas::AtlasDescription& atlas = store->description();
    question.texel_m = atlas.patches.texel_m;
    question.mips = std::countr_zero(atlas.patches.texels_per_side) + 1;
    question.ground_apart = atlas::keeps_ground_apart(atlas);
  }
  return question;
}

}  // namespace sigmascape::simulate
