#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "sigmascape/base/array2d.h"
#include "sigmascape/radar/complex_channels.h"
#include "sigmascape/radar/window.h"
#include "sigmascape/receiver/response_axis.h"
#include "sigmascape/receiver/row_bands.h"
#include "sigmascape/receiver/spreading_kernel.h"

namespace sigmascape::receiver {

/// Bins in which every amplitude answers with the exact two-dimensional response of a coherent receiver, at its exact
/// place: what a processor would make of the pulses, without making the pulses. The brightest bin of a lone point that
/// lies on a bin's centre holds its amplitude.
///
/// Amplitudes are spread over samples at twice the band, and the responses laid over all of them at once by Fourier
/// transforms. The result does not depend on the number of threads.
class ResponsePlane {
 public:
  ResponsePlane(const ResponseAxis& columns, const ResponseAxis& rows);

  [[nodiscard]] const ResponseAxis& columns() const { return columns_; }
  /// How many times as wide as those of all of the band the resolution cells of a look are, by the noise bandwidth of
  /// the weights that each has: as there are looks, and more where the band does not divide by them. A look of few
  /// frequencies has a few samples of its window and another noise bandwidth than that.
  [[nodiscard]] double cells_of_a_look(std::size_t looks) const {
    const auto width = [this](std::size_t frequencies) {
      return radar::noise_bandwidth(columns_.window, frequencies) / static_cast<double>(frequencies);
    };
    return width(std::max<std::size_t>(1, columns_.band / looks)) / width(columns_.band);
  }

  /// Adds amplitudes at places in units of bins.
  void add(std::span<const PlacedAmplitude> placed, unsigned threads = 0);

  /// [column, row]. With `subband`, that part of the band over columns alone: looks of different parts see independent
  /// speckle.
  [[nodiscard]] Array2D<radar::ComplexChannels> bins(const Subband& subband = {}, unsigned threads = 0) const;
  /// The same bins of nothing but noise: complex Gaussian, white over both bands, shaped by both windows, of power one
  /// in the mean and independent between polarizations. A pure function of the seed; looks of different parts of the
  /// band have independent noise.
  [[nodiscard]] Array2D<radar::ComplexChannels> noise(std::uint64_t seed, const Subband& subband = {},
                                                      unsigned threads = 0) const;

 private:
  ResponseAxis columns_, rows_;
  std::size_t fine_columns_, fine_rows_;
  SpreadingKernel kernel_;
  Array2D<radar::ComplexChannels> fine_;  // with a margin of the kernel's reach on all sides
};

}  // namespace sigmascape::receiver
