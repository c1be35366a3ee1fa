#pragma once

#include "physics/level_terrain.h"

#include "sigmascape/radar/ground_grid.h"
#include "sigmascape/terrain/height_field.h"

namespace sigmascape::simulate {

/// Two kilometres square about the origin.
inline const terrain::HeightField level_ground = level_terrain();

/// 100 m square in the middle of it.
inline constexpr radar::Rectangle small_area{-50.0, -50.0, 50.0, 50.0};

}  // namespace sigmascape::simulate
