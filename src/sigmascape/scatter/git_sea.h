#pragma once

#include "sigmascape/scatter/permittivity.h"
#include "sigmascape/scatter/reciprocal_backscatter.h"

namespace sigmascape::scatter {

/// Mean σ0 of the sea at low grazing angles [Horst, Dyer and Tuley 1978, Georgia Tech], as the product of interference,
/// wind direction and wind speed factors:
///
///     σ0_HH = 3.9·10⁻⁶ λ ψ^0.4 A_i A_u A_w                          docs/physics/git_sea.md, Eqs. (1)–(6)
///
/// From 0.1° to 10° of grazing; above, γ stays that of 10°. One wind angle holds for all directions of look.
[[nodiscard]] Sigma0 git_sea_sigma0(const GitSeaParameters& parameters, double frequency_hz, double grazing_rad);

/// The same as a surface for paths of any number of bounces.
[[nodiscard]] ReciprocalBackscatter git_sea(const GitSeaParameters& parameters, double frequency_hz);

inline constexpr FrequencyRange git_sea_frequencies{1e9, 10e9};

}  // namespace sigmascape::scatter
