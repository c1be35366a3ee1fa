#include "sigmascape/render/detail_of_ground.h"

namespace sigmascape::render {

DetailQuestion with_ground(DetailQuestion question, const LiveGround& ground) {
  const terrain::TerrainPyramid& terrain = ground.terrain().pyramid();
  question.texel_m = ground.description().patches.texel_m;
  question.mips = static_cast<int>(ground.coarsest_level()) + 1;
  question.terrain_spacing_m = terrain.layout().spacing_m;
  question.terrain_levels = terrain.levels();
  question.ground_apart = ground.obstacles() != nullptr;
  return question;
}

}  // namespace sigmascape::render
