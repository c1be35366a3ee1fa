#pragma once

#include <cstddef>
#include <vector>

#include "sigmascape/atlas/half.h"
#include "sigmascape/atlas/tile_reader.h"

namespace sigmascape::live {

/// One look of a tile in fewer texels than are stored, each the mean of what it covers of the atlas' extent.
struct CoarseLook {
  std::vector<atlas::Half> halves;  ///< [row][column][channel], north up
  double scale = 0.0;               ///< σ0 of a stored 1; 0 when the look cannot be had
};

/// With `side` texels a side, a power of two up to atlas::tile_side. A tile that cannot be read is made of the four
/// that it covers of the next finer level; those beyond the extent of the atlas are black.
[[nodiscard]] CoarseLook coarse_look(const atlas::TileReader& tiles, const atlas::TileAddress& tile,
                                     atlas::LookIndex look, std::size_t side);

}  // namespace sigmascape::live
