#pragma once

#include "sigmascape/terrain/height_field.h"

namespace sigmascape {

/// At the height of the sea about the origin.
inline terrain::HeightField level_terrain(double half_side_m = 1000.0) {
  return {.west_m = -half_side_m,
          .north_m = half_side_m,
          .spacing_m = half_side_m / 20.0,
          .height_m = Array2D<float>(41, 41, 0.0F)};
}

}  // namespace sigmascape
