#pragma once

#include "sigmascape/radar/ground_grid.h"
#include "sigmascape/scene/land_cover_reader.h"
#include "sigmascape/terrain/height_field.h"

namespace sigmascape::scene {

/// Lays the terrain under water flat at `level_m`: every node that bears on the height of a water cell, so that no
/// water cell is tilted, if it is not further than `within_m` from that level already (a lake in the hills stays where
/// it is). Returns how many nodes were moved.
std::size_t level_water(terrain::HeightField& terrain, const radar::GroundGrid& grid, const WaterMask& water,
                        double level_m, double within_m);

}  // namespace sigmascape::scene
