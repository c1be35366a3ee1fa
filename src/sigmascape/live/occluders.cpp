#include "sigmascape/live/occluders.h"

#include <algorithm>

namespace sigmascape::live {

terrain::HeightBounds Occluders::bounds() const {
  const terrain::TerrainView& before = ground_before();
  return {std::min(terrain.lowest_m, before.lowest_m) - lowered_m,
          std::max(terrain.highest_m, before.highest_m) + tallest_m};
}

}  // namespace sigmascape::live
