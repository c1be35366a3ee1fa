#pragma once

#include <cstddef>
#include <vector>

#include "sigmascape/base/array2d.h"
#include "sigmascape/radar/channels.h"
#include "sigmascape/radar/obstacle.h"

namespace sigmascape::atlas {

/// One patch at several resolutions: level 0 is the finest, each next has half the texels a side. [column, row], north
/// up.
using MipChain = std::vector<Array2D<radar::Channels>>;
/// The same of what stands on the patch.
using ObstacleChain = std::vector<Array2D<radar::Obstacle>>;

/// Half the columns and rows, each texel the mean of the four it covers. σ0 is power per area, so that its area mean
/// keeps power; the same holds for the correlation channel. Columns and rows must be even.
[[nodiscard]] Array2D<radar::Channels> area_mean(const Array2D<radar::Channels>& finer);

/// Level 0 and all levels below it down to `smallest_side` texels, each from the one before it without rounding
/// between.
[[nodiscard]] MipChain mip_chain(Array2D<radar::Channels> level_0, std::size_t smallest_side);
[[nodiscard]] ObstacleChain mip_chain(radar::ObstacleMap level, std::size_t smallest_side);

}  // namespace sigmascape::atlas
