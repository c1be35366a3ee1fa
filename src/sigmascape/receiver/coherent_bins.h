#pragma once

#include <span>

#include "sigmascape/base/array2d.h"
#include "sigmascape/radar/complex_channels.h"
#include "sigmascape/receiver/row_bands.h"

namespace sigmascape::receiver {

/// The weighted histogram in amplitude: complex sums in a rectangle of bins, a polarization each, the same for any
/// number of threads.
class CoherentBins {
 public:
  CoherentBins(std::size_t columns, std::size_t rows) : sums_(columns, rows) {}

  /// Shares every amplitude between the four nearest bins, by weights whose squares sum to one: the square roots of the
  /// linear weights of the power mode. The power of scatterers with independent phases is kept in expectation.
  /// docs/physics/speckle.md, Eq. (5). What falls outside is left out.
  void add(std::span<const PlacedAmplitude> placed, unsigned threads = 0);

  /// [column, row].
  [[nodiscard]] const Array2D<radar::ComplexChannels>& sums() const { return sums_; }

 private:
  Array2D<radar::ComplexChannels> sums_;
};

}  // namespace sigmascape::receiver
