#pragma once

#include <complex>

namespace sigmascape::scatter {

/// Leaves, stalks and fresh wood as bulk material with free and bound water [Ulaby and El-Rayes 1987]:
///
///     ε = ε_r + v_f [4.9 + 74.4/(1 + j f/18) − 18 j σ/f] + v_b [2.9 + 55/(1 + √(j f/0.18))],   f in GHz
///
/// docs/physics/permittivity.md, Eqs. (11), (12). From 0.2 to 20 GHz at room temperature.
struct VegetationPermittivity {
  double gravimetric_moisture = 0.6;  ///< water over total mass, 0 to 0.7
  double salinity_g_per_kg = 15.0;    ///< of the free water

  friend constexpr bool operator==(const VegetationPermittivity&, const VegetationPermittivity&) = default;

  [[nodiscard]] std::complex<double> relative_at(double frequency_hz) const;
};

}  // namespace sigmascape::scatter
