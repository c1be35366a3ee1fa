#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>

#include "sigmascape/base/array2d.h"
#include "sigmascape/radar/channels.h"
#include "sigmascape/receiver/response_plane.h"

namespace sigmascape::receiver {

/// Noise that an image has beside what answers: its mean power in each row, for an image of all of the band over
/// columns. Without a function there is none.
struct RowNoise {
  std::function<double(std::size_t row)> power = {};
  std::uint64_t seed = 1;
};

/// Rows `first` … `first + count − 1` of the plane, of a part of the band over columns, with noise. `row` of the noise
/// counts from `first`.
[[nodiscard]] Array2D<radar::ComplexChannels> noisy_rows(const ResponsePlane& plane, const RowNoise& noise,
                                                         std::size_t first, std::size_t count,
                                                         const Subband& subband = {}, unsigned threads = 0);

/// Mean power over looks of equal parts of the band over columns, of those rows: L looks of even clutter have L times
/// the mean² over variance of one, and an L-th of its resolution. Throws Error when there are more looks than
/// frequencies. docs/physics/speckle.md, Eq. (6).
[[nodiscard]] Array2D<radar::Channels> multilooked(const ResponsePlane& plane, const RowNoise& noise, std::size_t looks,
                                                   std::size_t first, std::size_t count, unsigned threads = 0);

}  // namespace sigmascape::receiver
