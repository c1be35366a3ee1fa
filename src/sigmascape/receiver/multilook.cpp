#include "sigmascape/receiver/multilook.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

#include "sigmascape/base/error.h"
#include "sigmascape/base/parallel.h"

namespace sigmascape::receiver {

Array2D<radar::ComplexChannels> noisy_rows(const ResponsePlane& plane, const RowNoise& noise, std::size_t first,
                                           std::size_t count, const Subband& subband, unsigned threads) {
  if (subband.looks < 1 || subband.looks > plane.columns().band) {
    throw Error("multilook", fmt::format("{} looks of {} pulses are asked for", subband.looks, plane.columns().band),
                "take at least one pulse a look");
  }
  const auto all = plane.bins(subband, threads);
  Array2D<radar::ComplexChannels> rows(all.columns(), count);
  for (std::size_t row = 0; row < count; ++row) std::ranges::copy(all.row(first + row), rows.row(row).begin());
  if (!noise.power) return rows;
  const auto unit_noise = plane.noise(noise.seed, subband, threads);
  parallel_for(count, threads, [&](std::size_t row, unsigned) {
    // A look adds up fewer pulses.
    const auto amplitude = static_cast<float>(std::sqrt(noise.power(row) * plane.cells_of_a_look(subband.looks)));
    for (std::size_t column = 0; column < rows.columns(); ++column) {
      const float lifted = noise.lift ? static_cast<float>(std::sqrt(noise.lift(column, row))) : 1.0F;
      rows(column, row) += unit_noise(column, first + row) * (amplitude * lifted);
    }
  });
  return rows;
}

}  // namespace sigmascape::receiver
