#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "sigmascape/base/array2d.h"
#include "sigmascape/radar/echo.h"
#include "sigmascape/simulate/launch_for_map.h"
#include "sigmascape/simulate/pass_sums.h"

namespace sigmascape::simulate {

/// What the rays of each launch cell bring of noise into the bins of a map's area, measured on a pass over all cells
/// against the map of the passes before it. An echo of cross-section σ from a ray that is one of m in its cell counts
///
///     (σ / (P + σ/m))²
///
/// P being the power of its bin so far; so one that a bin has not seen the like of counts no more than m².
/// docs/decisions/0097-rays-where-the-noise-is.md.
class CellNoise {
 public:
  /// All are held by reference.
  CellNoise(const trace::LaunchArea& launch, const PassSums& map, std::uint32_t samples_per_cell);

  /// One ray's echoes. May be called from several threads at once for different cells.
  void add(const trace::LaunchCell& cell, std::span<const radar::Echo> echoes);

  /// The cells by how many rays a pass is to give them: `most` where the noise of the cells around, at most two away
  /// along either axis, is in the mean at least half of what it is around the median cell of those that bring noise at
  /// all; elsewhere fewer in proportion, rounded up to `most` halved some times, and one at least.
  [[nodiscard]] std::vector<LaunchShare> shares(std::uint32_t most) const;

 private:
  [[nodiscard]] double around(const trace::LaunchCell& cell) const;
  [[nodiscard]] std::size_t column_of(const trace::LaunchCell& cell) const;
  [[nodiscard]] std::size_t row_of(const trace::LaunchCell& cell) const;

  const trace::LaunchArea& launch_;
  const PassSums& map_;
  double samples_per_cell_;
  trace::LaunchCell first_;        // of the arrays
  Array2D<double> noise_;          // [i, j]
  Array2D<std::uint8_t> is_cell_;  // that is launched
};

}  // namespace sigmascape::simulate
