#pragma once

#include "sigmascape/radar/ground_grid.h"
#include "sigmascape/scene/land_cover_reader.h"
#include "sigmascape/terrain/height_field.h"
#include "sigmascape/terrain/terrain_reader.h"

namespace sigmascape::scene {

/// Lays the terrain under water flat at `level_m`: every node that bears on the height of a water cell, so that no
/// water cell is tilted, if it is not further than `within_m` from that level already (a lake in the hills stays where
/// it is). The heights of `filled` nodes are those of the shore, of which cliffs say nothing about the water before
/// them: such water is levelled whatever its height, unless ground that lies higher than `within_m` above the level
/// closes it in on all sides, within the terrain, as it does a lake in the hills. Returns how many nodes were moved.
std::size_t level_water(terrain::HeightField& terrain, const terrain::NodeMask& filled, const radar::GroundGrid& grid,
                        const WaterMask& water, double level_m, double within_m);

}  // namespace sigmascape::scene
