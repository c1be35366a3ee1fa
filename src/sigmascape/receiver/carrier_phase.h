#pragma once

#include <complex>
#include <cstdint>

#include "sigmascape/radar/complex_gaussian.h"

namespace sigmascape::receiver {

/// exp(−4πi r/λ), the way out and back: whole turns are taken off in double precision before the rest becomes float.
[[nodiscard]] inline std::complex<float> carrier_phase(double range_m, double wavelength_m) {
  const double turns = -2.0 * range_m / wavelength_m;
  // Rounded down by way of an integer: without it, floor is a call of the library.
  const auto near = static_cast<double>(static_cast<std::int64_t>(turns));
  const double part = turns - (near > turns ? near - 1.0 : near);
  const radar::ComplexPair phasor =
      radar::unit_phasor(static_cast<std::uint32_t>(static_cast<std::int64_t>(part * 0x1p32)));
  return {phasor.re, phasor.im};
}

}  // namespace sigmascape::receiver
