#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>

#include "sigmascape/base/array2d.h"
#include "sigmascape/radar/complex_channels.h"
#include "sigmascape/receiver/response_plane.h"

namespace sigmascape::receiver {

/// Noise that an image has beside what answers: its mean power in each row, for an image of all of the band over
/// columns. Without a function there is none.
struct RowNoise {
  std::function<double(std::size_t row)> power = {};
  std::uint64_t seed = 1;
  /// By how much that is lifted in a bin; without a function by nothing. Called from several threads at once.
  std::function<double(std::size_t column, std::size_t row)> lift = {};
};

/// Rows `first` … `first + count − 1` of the plane, of a part of the band over columns, with noise. `row` of the noise
/// counts from `first`. The mean power of L looks of even clutter has L times the mean² over variance of one, and an
/// L-th of its resolution: docs/physics/speckle.md, Eq. (6). Throws Error when there are more looks than frequencies.
[[nodiscard]] Array2D<radar::ComplexChannels> noisy_rows(const ResponsePlane& plane, const RowNoise& noise,
                                                         std::size_t first, std::size_t count,
                                                         const Subband& subband = {}, unsigned threads = 0);

}  // namespace sigmascape::receiver
