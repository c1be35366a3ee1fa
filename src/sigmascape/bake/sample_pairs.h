#pragma once

#include <bit>
#include <cstdint>

#include "sigmascape/base/sobol.h"

namespace sigmascape::bake {

/// Which of a cell's n samples each is held against to tell the noise of their sum.
///
/// The samples are the first n points of the cell's sequence. They fall into runs of 2^k points, one for each binary
/// digit of n, the longest first, and within a run into pairs that lie beside one another in the cell
/// (SobolPoint::neighbour). Of an odd number the last stays alone.
class SamplePairs {
 public:
  explicit constexpr SamplePairs(std::uint32_t samples) : samples_(samples) {}

  [[nodiscard]] constexpr std::uint32_t samples() const { return samples_; }

  /// Whether that sample has none beside it.
  [[nodiscard]] constexpr bool is_alone(std::uint32_t sample) const {
    return samples_ % 2 == 1 && sample == samples_ - 1;
  }

  /// The sample beside one that is not alone.
  [[nodiscard]] constexpr std::uint32_t beside(std::uint32_t sample) const {
    // Of the digits of n the run's is the highest in which the sample's differ from them.
    const auto k = static_cast<unsigned>(std::bit_width(sample ^ samples_)) - 1U;
    return SobolPoint::neighbour(sample, k);
  }

 private:
  std::uint32_t samples_;
};

}  // namespace sigmascape::bake
