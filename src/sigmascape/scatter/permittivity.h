#pragma once

#include <complex>

namespace sigmascape::scatter {

/// How a homogeneous material answers an electric field, over frequency.
///
///     ε_r = a · f^b,   σ = c · f^d [S/m],   f in GHz        ITU-R P.2040-3, Eqs. (28), (29)
///     ε = ε_r − j σ / (ω ε_0)
///
/// A constant relative permittivity and conductivity is the case b = d = 0.
struct Permittivity {
  double a = 1.0;
  double b = 0.0;
  double c = 0.0;
  double d = 0.0;

  friend constexpr bool operator==(const Permittivity&, const Permittivity&) = default;

  [[nodiscard]] std::complex<double> relative_at(double frequency_hz) const;
};

}  // namespace sigmascape::scatter
