#pragma once

#include <cstddef>

#include "sigmascape/radar/ground_map.h"

namespace sigmascape::cli {

inline constexpr double power_tile_m = 32.0;
/// Four channels in half floats.
inline constexpr std::size_t bytes_a_tile = 8;

/// Scales every tile of `power_tile_m` so that its cells together have the power, VV + HH + 2·HV, that they have in the
/// reference, a map of the same cells. A tile without power, or not seen wholly by both, stays as it is. Returns the
/// number of tiles.
std::size_t give_power_of_tiles(radar::GroundMap& map, const radar::GroundMap& reference);

}  // namespace sigmascape::cli
