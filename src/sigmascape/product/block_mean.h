#pragma once

#include <cstddef>

#include "sigmascape/base/array2d.h"
#include "sigmascape/radar/channels.h"
#include "sigmascape/radar/ground_map.h"

namespace sigmascape::product {

/// Mean linear power over blocks of `factor` × `factor` cells, counted from the map's north-western corner: [column,
/// row]. A block with an unseen (NaN) cell is NaN; what is left over on the eastern and southern edge belongs to no
/// block. Assumes factor ≥ 1.
[[nodiscard]] Array2D<double> block_mean(const Array2D<radar::Channels>& cells, radar::Polarization polarization,
                                         std::size_t factor);
[[nodiscard]] inline Array2D<double> block_mean(const radar::GroundMap& map, radar::Polarization polarization,
                                                std::size_t factor) {
  return block_mean(map.sigma0, polarization, factor);
}

}  // namespace sigmascape::product
