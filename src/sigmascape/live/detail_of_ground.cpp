#include "sigmascape/live/detail_of_ground.h"

namespace sigmascape::live {

render::DetailQuestion with_ground(render::DetailQuestion question, const LiveGround& ground) {
  const terrain::TerrainPyramid& terrain = ground.terrain().pyramid();
  question.texel_m = ground.description().patches.texel_m;
  question.mips = static_cast<int>(ground.coarsest_level()) + 1;
  question.terrain_spacing_m = terrain.layout().spacing_m;
  question.terrain_levels = terrain.levels();
  question.ground_apart = ground.obstacles() != nullptr;
  return question;
}

}  // namespace sigmascape::live
