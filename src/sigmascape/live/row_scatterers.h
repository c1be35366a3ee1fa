#pragma once

#include <array>

#include "sigmascape/live/lattice_row.h"

namespace sigmascape::live {

/// Cross-sections to amplitudes of scatterers with the travel phase: √P ξ exp(−j 4π r/λ), VV and HH drawn with their
/// stored correlation. `gaussians` are three complex numbers a texel, real and imaginary parts in arrays of their own.
void scatter(LatticeRow& row, const std::array<LatticeRow::Of<float>, 6>& gaussians, double turns_per_m);

}  // namespace sigmascape::live
