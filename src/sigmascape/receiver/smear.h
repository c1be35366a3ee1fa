#pragma once

#include <complex>
#include <vector>

namespace sigmascape::receiver {

/// A part of a smeared point: so many resolution cells from its place, with this amplitude.
struct SmearedPart {
  double cells = 0.0;
  std::complex<float> amplitude;
};

/// What becomes of a point whose Doppler changes otherwise than the processor takes it to, by so much, over the
/// coherent interval: the Fourier series of the left-over phase,
///
///     exp(πi Δk t²) = Σ_m c_m exp(2πi m t/T),   |t| ≤ T/2                     docs/physics/doppler.md, Eq. (8)
///
/// one part each at m cells. Powers add up to one. A point that is in focus has one part.
[[nodiscard]] std::vector<SmearedPart> smeared(double doppler_rate_error_hz_per_s, double interval_s);

}  // namespace sigmascape::receiver
