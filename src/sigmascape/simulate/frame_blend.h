#pragma once

#include <complex>
#include <span>

namespace sigmascape::simulate {

/// Two frames of the same bins as one, the second with that share of the power:
///
///     P = (1 − s) P₁ + s P₂
///
/// in every number of every bin. All three are of one length; `blended` may be either of the others.
void blend_powers(std::span<const float> first, std::span<const float> second, double second_share,
                  std::span<float> blended);

/// The same for I/Q, whose power in every bin is (1 − s) |a₁|² + s |a₂|², whatever the two have to do with one another.
/// Its phase is that of (1 − s) a₁ + s a₂: what both frames hold alike, scatterers of one lattice or targets, stays as
/// it is. docs/decisions/0105-between-traced-and-baked.md says why weights alone, √s or s, would show.
void blend_amplitudes(std::span<const std::complex<float>> first, std::span<const std::complex<float>> second,
                      double second_share, std::span<std::complex<float>> blended);

}  // namespace sigmascape::simulate
