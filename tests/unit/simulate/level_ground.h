#pragma once

#include "sigmascape/radar/ground_grid.h"
#include "sigmascape/terrain/height_field.h"

namespace sigmascape::simulate {

/// Two kilometres square about the origin.
inline const terrain::HeightField level_ground{
    .west_m = -1000.0, .north_m = 1000.0, .spacing_m = 50.0, .height_m = Array2D<float>(41, 41, 0.0F)};

/// 100 m square in the middle of it.
inline constexpr radar::Rectangle small_area{-50.0, -50.0, 50.0, 50.0};

}  // namespace sigmascape::simulate
