#pragma once

#include <cstddef>

#include "sigmascape/base/array2d.h"
#include "sigmascape/radar/channels.h"
#include "sigmascape/receiver/response_plane.h"

namespace sigmascape::receiver {

/// Rows `first` … `first + count − 1`.
[[nodiscard]] Array2D<radar::ComplexChannels> rows_from(const Array2D<radar::ComplexChannels>& all, std::size_t first,
                                                        std::size_t count);

/// Mean power over looks of equal parts of the band over columns, of those rows: L looks of even clutter have L times
/// the mean² over variance of one, and an L-th of its resolution. Throws Error when there are more looks than
/// frequencies. docs/physics/speckle.md, Eq. (6).
[[nodiscard]] Array2D<radar::Channels> multilooked(const ResponsePlane& plane, std::size_t looks, std::size_t first,
                                                   std::size_t count, unsigned threads = 0);

}  // namespace sigmascape::receiver
