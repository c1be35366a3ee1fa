#pragma once

#include <cstddef>

#include "sigmascape/live/lattice_row.h"

namespace sigmascape::live {

/// Bins of a sector: [beam][range][number], numbers of a bin side by side. Only beams from the first up to the end are
/// added to.
struct SectorBins {
  float* bins = nullptr;
  std::size_t first_beam = 0, end_beam = 0, ranges = 0;
  std::size_t stride = 0;  ///< bins from one beam to the next
};

/// Adds the amplitudes, eight numbers a bin (VV, HH, HV, VH, real and imaginary), shared between the four nearest bins,
/// or those of all beams that a texel is wide, by weights whose squares sum to one.
void deposit_amplitudes(LatticeRow& row, const SectorBins& sector);
/// Adds the powers, four numbers a bin, shared by weights that sum to one.
void deposit_powers(LatticeRow& row, const SectorBins& sector);

}  // namespace sigmascape::live
