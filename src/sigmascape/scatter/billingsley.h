#pragma once

#include "sigmascape/scatter/permittivity.h"
#include "sigmascape/scatter/reciprocal_backscatter.h"

namespace sigmascape::scatter {

/// Mean strength σ0 F⁴ of land clutter of low relief by depression angle [Billingsley 2002, interim model]. The
/// propagation factor F is part of the measurement and is not removed. Depression is taken as the grazing angle;
/// polarizations are alike. docs/physics/billingsley.md.
[[nodiscard]] Sigma0 billingsley_sigma0(const BillingsleyParameters& parameters, double grazing_rad);

/// The same as a surface for paths of any number of bounces.
[[nodiscard]] ReciprocalBackscatter billingsley(const BillingsleyParameters& parameters);

/// Where the rows of that terrain were measured and seen.
[[nodiscard]] FrequencyRange billingsley_frequencies(BillingsleyTerrain terrain);

}  // namespace sigmascape::scatter
