#pragma once

#include <cstdint>
#include <vector>

#include "sigmascape/atlas/mip_chain.h"
#include "sigmascape/base/array2d.h"

namespace sigmascape::atlas {

/// How many bits of mantissa are worth storing of each texel of a mip chain: [level](column, row).
using BitsOfTexels = std::vector<Array2D<std::uint8_t>>;

/// Of a number whose relative standard error is r as many as are needed for rounding, at most half of the last one, to
/// stay within an eighth of the error,
///
///     b = ⌈log₂(4 / r)⌉, at least 1 and at most `most`,
///
/// which adds no more than (1/4)²/12 of it, half a hundredth, to the variance. What lies below is noise, and bytes.
[[nodiscard]] int worthwhile_bits(double relative_error, int most);

/// The same for all texels of a chain. `relative_errors` are those of the total power of its finest level; of a mean of
/// four independent errors are taken to be so, which where they go together keeps a bit too many.
[[nodiscard]] BitsOfTexels worthwhile_bits(const MipChain& chain, const Array2D<float>& relative_errors, int most);

}  // namespace sigmascape::atlas
