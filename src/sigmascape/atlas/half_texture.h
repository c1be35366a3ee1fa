#pragma once

#include <cstddef>
#include <vector>

#include "sigmascape/atlas/half.h"
#include "sigmascape/atlas/mip_chain.h"

namespace sigmascape::atlas {

/// A mip chain as it is stored: halves times one power of two. [level][(row · columns + column) · 4 + channel].
struct HalfTexture {
  std::size_t side = 0;  ///< texels of the first level held
  double scale = 1.0;    ///< σ0 of a stored 1
  std::vector<std::vector<Half>> levels;
};

/// The power of two that σ0 is to be divided by before it becomes halves: the brightest texel of level 0 lands between
/// 2¹⁴ and 2¹⁵, so that it fits whatever it is, and dark ground keeps as many bits as can be. 1 when all is black.
[[nodiscard]] double fitting_scale(const Array2D<radar::Channels>& level_0);

/// All levels rounded to the nearest half of so many mantissa bits, under the given scale.
[[nodiscard]] HalfTexture encoded(const MipChain& chain, double scale, int mantissa_bits);

/// σ0 again.
[[nodiscard]] MipChain decoded(const HalfTexture& texture);

}  // namespace sigmascape::atlas
