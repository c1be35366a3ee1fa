#pragma once

#include <cstddef>

#include "sigmascape/radar/ground_grid.h"
#include "sigmascape/radar/ground_map.h"

namespace sigmascape::product {

/// Throws Error, saying how they differ, unless both maps have the same cells in the same frame.
void require_same_cells(const radar::GroundMap& tested, const radar::GroundMap& truth);

/// How many of the map's cells go into one of `cell_m` along each side; zero when no whole number does.
[[nodiscard]] std::size_t block_factor(double cell_m, const radar::GroundGrid& grid);

/// The same; throws Error when no whole number does.
[[nodiscard]] std::size_t required_block_factor(double cell_m, const radar::GroundGrid& grid);

}  // namespace sigmascape::product
