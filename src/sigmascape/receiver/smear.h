#pragma once

#include <complex>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "sigmascape/radar/target.h"

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

/// The pulses that a target is looked at with, and the number of their dwell.
struct Dwell {
  double interval_s = 0.0;
  std::size_t pulses = 1;
  std::uint64_t number = 0;
};

/// The same of a target of one square metre in the mean that fluctuates. One that changes from pulse to pulse is spread
/// over all Doppler: a part for each pulse, the Fourier series of the phases times √q of the pulses. What is left at
/// its place has π/4 of the mean power in Swerling's case 2 and 9π/32 in case 4, of many pulses.
[[nodiscard]] std::vector<SmearedPart> smeared(const radar::Target& target, double doppler_rate_error_hz_per_s,
                                               const Dwell& dwell);

}  // namespace sigmascape::receiver
