#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "sigmascape/base/vec.h"
#include "sigmascape/radar/complex_channels.h"
#include "sigmascape/radar/complex_gaussian.h"

namespace sigmascape::radar {

/// Number of a cell of the lattice: cell (0, 0) has its south-western corner at the origin of the local frame; columns
/// count eastward and rows northward.
struct LatticeCell {
  std::int32_t column = 0;
  std::int32_t row = 0;

  friend constexpr bool operator==(LatticeCell, LatticeCell) = default;
};

/// The three independent Gaussian numbers of a cell, from which `polarized` makes the polarizations.
enum class Draw { First, Second, Third };

struct DrawnCell {
  ComplexPair first, second, third;
};

/// The amplitudes (metres) of a scatterer whose mean cross-sections are `rcs_m2`: VV and HH correlated as Re VV·HH*
/// says, HV independent of both.
///
///     VV = √P_vv ξ₁,   HH = √P_hh (ρ ξ₁ + √(1 − ρ²) ξ₂),   HV = √P_hv ξ₃      docs/physics/speckle.md, Eq. (2)
[[nodiscard]] ComplexChannels polarized(const DrawnCell& drawn, const Channels& rcs_m2);

struct LatticeOptions {
  std::uint64_t seed = 1;
  double cell_m = 1.0;  ///< side of a cell of level 0
  /// Levels 0 … levels − 1 are tied together: a cell is the normalised sum of the four that it covers. Coarser
  /// ones are drawn by themselves. With one level all are, which is the fastest. At most 24.
  int levels = 1;
};

/// The scatterers of the ground: one in every cell of a lattice that is fixed to the world, at a hashed place and with
/// a hashed complex Gaussian value ξ, E|ξ|² = 1. Both are pure functions of seed, level and cell, so that the same
/// ground answers with the same phase from pulse to pulse and from frame to frame.
///
///     ξ(cell) = ½ Σ ξ(its four children)                                      docs/physics/speckle.md, Eq. (3)
///
/// holds between levels by construction: the coarsest level is drawn, and each finer one splits its parents by
/// independent differences. One cell costs 1 + 2·(levels − 1 − level) draws, a whole block one draw a cell.
class ScattererLattice {
 public:
  /// Throws Error when the cell is not positive or the number of levels not from 1 to 24.
  explicit ScattererLattice(const LatticeOptions& options);

  [[nodiscard]] int levels() const { return options_.levels; }
  [[nodiscard]] double cell_m(int level) const { return options_.cell_m * static_cast<double>(1U << level); }
  [[nodiscard]] LatticeCell cell_at(Vec2d point, int level) const;
  /// Where in the cell its scatterer stands, evenly distributed over the cell. Levels have places of their own.
  [[nodiscard]] Vec2d position_in(LatticeCell cell, int level) const;

  /// The same for `x_m.size()` cells of a row, from `first` eastwards.
  void positions_of(LatticeCell first, int level, std::span<double> x_m, std::span<double> y_m) const;

  [[nodiscard]] ComplexPair value_of(LatticeCell cell, int level, Draw draw) const;
  [[nodiscard]] DrawnCell drawn(LatticeCell cell, int level) const;

  /// The same for many cells at once: `columns`, `rows`, `re` and `im` have equal lengths. Gives the numbers that
  /// `value_of` gives, several times faster.
  void values_of(std::span<const std::int32_t> columns, std::span<const std::int32_t> rows, int level, Draw draw,
                 std::span<float> re, std::span<float> im) const;

  /// All cells of `level` within one cell of a coarser level, `depth` levels above it: [row, column] from the
  /// south-west, 2^depth a side. The same numbers again, at one draw a cell.
  void block(LatticeCell coarse, int level, int depth, Draw draw, std::vector<ComplexPair>& out) const;

 private:
  [[nodiscard]] std::uint64_t key(int level, Draw draw, int purpose) const;

  LatticeOptions options_;
};

}  // namespace sigmascape::radar
