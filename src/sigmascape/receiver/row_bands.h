#pragma once

#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

#include "sigmascape/base/parallel.h"
#include "sigmascape/radar/complex_channels.h"

namespace sigmascape::receiver {

/// An amplitude and its place in units of bins, (0.5, 0.5) being the centre of bin (0, 0).
struct PlacedAmplitude {
  double column = 0.0;
  double row = 0.0;
  radar::ComplexChannels amplitude;
};

/// Hands out amplitudes so that many threads may add them into shared rows of floating-point bins and the sums are the
/// same for any number of threads.
///
/// Rows are cut into bands of fixed height. All amplitudes of a band go to one thread, in the order in which they were
/// given; first the even bands, then the odd ones, so that no two bands that are worked on touch one row.
/// docs/decisions/0030-coherent-bins.md.
class RowBands {
 public:
  /// `reach` rows above and below its own may be touched by an amplitude: at most half of `band_rows`.
  static constexpr std::size_t band_rows = 16;

  /// What stands more than a band outside the rows is left out.
  RowBands(std::span<const PlacedAmplitude> placed, std::size_t rows) : placed_(placed) {
    const auto bands = rows / band_rows + 3;
    starts_.assign(bands + 1, 0);
    std::vector<std::size_t> band_of(placed.size());
    for (std::size_t i = 0; i < placed.size(); ++i) {
      const double band = std::floor(placed[i].row / static_cast<double>(band_rows)) + 1.0;
      // Not a number goes with what is far outside.
      const bool inside = band >= 0.0 && band < static_cast<double>(bands);
      band_of[i] = inside ? static_cast<std::size_t>(band) : bands;
      if (inside) ++starts_[band_of[i] + 1];
    }
    for (std::size_t b = 0; b < bands; ++b) starts_[b + 1] += starts_[b];
    order_.resize(starts_[bands]);
    std::vector<std::size_t> next(starts_.begin(), starts_.end() - 1);
    for (std::size_t i = 0; i < placed.size(); ++i) {
      if (band_of[i] < bands) order_[next[band_of[i]]++] = i;
    }
  }

  template <typename Body>
  void for_each(unsigned threads, const Body& body) const {
    const std::size_t bands = starts_.size() - 1;
    for (std::size_t parity = 0; parity < 2; ++parity) {
      parallel_for((bands - parity + 1) / 2, threads, [&](std::size_t pair, unsigned) {
        const std::size_t band = 2 * pair + parity;
        for (std::size_t i = starts_[band]; i < starts_[band + 1]; ++i) body(placed_[order_[i]]);
      });
    }
  }

 private:
  std::span<const PlacedAmplitude> placed_;
  std::vector<std::size_t> starts_, order_;
};

}  // namespace sigmascape::receiver
