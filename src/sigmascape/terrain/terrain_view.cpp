#include "sigmascape/terrain/terrain_view.h"

namespace sigmascape::terrain {

TerrainView view_of(const HeightField& field) {
  return {.west_m = field.west_m,
          .north_m = field.north_m,
          .spacing_m = field.spacing_m,
          .columns = field.height_m.columns(),
          .rows = field.height_m.rows(),
          .height_m = field.height_m.values(),
          .lowest_m = field.lowest_m(),
          .highest_m = field.highest_m()};
}

}  // namespace sigmascape::terrain
