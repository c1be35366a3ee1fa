#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "sigmascape/radar/echo.h"
#include "sigmascape/simulate/map_tracer.h"
#include "sigmascape/simulate/pass_sums.h"

namespace sigmascape::simulate {

/// What the rays of each launch cell bring of noise into the bins of a map's area, measured on a pass over all cells.
/// An echo of cross-section σ from a ray that is one of m in its cell counts
///
///     (σ / P)² / m
///
/// P being the power of its bin in that pass. docs/decisions/0097-rays-where-the-noise-is.md.
class CellNoise {
 public:
  /// Launch and sums are held by reference.
  CellNoise(const trace::LaunchArea& launch, const PassSums& sums, std::uint32_t samples_per_cell, unsigned workers);

  /// One ray's echoes. May be called by several workers at once for different cells.
  void add(const trace::LaunchCell& cell, std::span<const radar::Echo> echoes, unsigned worker);

  /// The cells by how many rays a pass is to give them, once the sums hold the pass that was looked at: `most` where
  /// the noise of the cells around, at most two away along either axis, is in the mean at least half of what it is
  /// around the median cell of those that bring noise at all; elsewhere fewer in proportion, rounded up to `most`
  /// halved some times. One at least where the radar sees something of the area directly, elsewhere one in four cells.
  /// Of cells about the target none gets more than its LaunchCell::share of `most`.
  [[nodiscard]] std::vector<LaunchShare> shares(std::uint32_t most) const;

 private:
  /// An echo in the area.
  struct Brought {
    trace::LaunchCell cell;
    std::uint32_t bin = 0;
    float rcs_m2 = 0.0F;
    bool direct = false;
  };
  /// Of the cells around one.
  struct Around {
    double noise = 0.0;
    bool is_seen = false;
  };
  [[nodiscard]] std::vector<Around> around_cells() const;
  [[nodiscard]] std::size_t column_of(const trace::LaunchCell& cell) const;
  [[nodiscard]] std::size_t row_of(const trace::LaunchCell& cell) const;

  const trace::LaunchArea& launch_;
  const PassSums& sums_;
  double samples_per_cell_;
  trace::LaunchCell first_;  // south-westernmost of the lattice's part
  std::size_t columns_ = 0, rows_ = 0;
  std::vector<std::vector<Brought>> brought_;  // [worker]
};

}  // namespace sigmascape::simulate
