#pragma once

#include "sigmascape/scatter/permittivity.h"
#include "sigmascape/scatter/reciprocal_backscatter.h"

namespace sigmascape::scatter {

/// Mean σ0 of the sea over all wind directions [Gregers-Hansen and Mital, Naval Research Laboratory]:
///
///     σ0 [dB] = c1 + c2 log sin ψ + (27.5 + c3 ψ) log f / (1 + 0.95 ψ) + c4 (1 + S)^(1/(2 + 0.085 ψ + 0.033 S)) + c5
///     ψ²
///
/// ψ in degrees, f in GHz, S the sea state. docs/physics/nrl_sea.md, Eq. (1). Above 60° γ stays that of 60°.
[[nodiscard]] Sigma0 nrl_sea_sigma0(const NrlSeaParameters& parameters, double frequency_hz, double grazing_rad);

/// The same as a surface for paths of any number of bounces.
[[nodiscard]] ReciprocalBackscatter nrl_sea(const NrlSeaParameters& parameters, double frequency_hz);

inline constexpr FrequencyRange nrl_sea_frequencies{0.5e9, 35e9};

}  // namespace sigmascape::scatter
