#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "sigmascape/radar/channels.h"
#include "sigmascape/radar/scatterer_lattice.h"

namespace sigmascape::simulate {

/// A rectangle of lattice cells.
struct LatticeBlock {
  radar::LatticeCell first;  ///< the south-western one
  std::size_t columns = 0, rows = 0;
};

/// What echoes bring to the cells of a lattice: their power and where in the bins its middle lies. From any number of
/// threads, with a result that does not depend on their order: sums are 64-bit integers in units of 2⁻³⁶ times the
/// cell's area at first, or up to half of that, which hold as much as ground of a σ0 of 75 dB returns. What does not
/// fit is left out and counted.
class LatticeSums {
 public:
  /// `cell_m`: side of a cell.
  LatticeSums(const LatticeBlock& block, double cell_m);

  [[nodiscard]] const LatticeBlock& block() const { return block_; }

  /// Where an echo lies, in beams and range bins from wherever its cell's user counts them: near by, so that products
  /// of power and place need no more room than power does.
  struct Place {
    double beam = 0.0, range = 0.0;
  };
  /// An echo in a cell outside the block goes to the nearest inside.
  void add(radar::LatticeCell cell, const radar::Channels& rcs_m2, Place place);

  /// To be called now and then, while nobody adds: once a sum is more than half full, all go on in units twice as
  /// large.
  void make_room();

  struct Sum {
    radar::Channels rcs_m2;  ///< the sum times `scale`
    Place place;             ///< mean of the echoes' places, weighted by their total power
  };
  /// Zero power for cells that nothing has come to. Column and row count within the block.
  [[nodiscard]] Sum sum(std::size_t column, std::size_t row, double scale) const;
  [[nodiscard]] std::uint64_t overflows() const { return overflows_; }

 private:
  enum Number : std::size_t { Vv, Hh, Hv, ReVvhh, BeamMoment, RangeMoment, Count };

  void add_units(std::int64_t& sum, double value);

  LatticeBlock block_;
  double units_per_m2_;
  std::vector<std::array<std::int64_t, Count>> cells_;  // [row, column]
  std::uint64_t overflows_ = 0;
};

}  // namespace sigmascape::simulate
