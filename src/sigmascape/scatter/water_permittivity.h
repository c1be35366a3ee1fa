#pragma once

#include <complex>

namespace sigmascape::scatter {

/// Fresh and salt water as two Debye relaxations and, where there is salt, ionic conduction [ITU-R P.527-4,
/// Section 5.1]:
///
///     ε = (ε_s − ε_1)/(1 + j f/f_1) + (ε_1 − ε_∞)/(1 + j f/f_2) + ε_∞ − 18 j σ/f
///
/// docs/physics/permittivity.md, Eqs. (3)–(6). From −4 to 40 °C, up to 40 g/kg, up to 1000 GHz.
struct WaterPermittivity {
  double temperature_c = 20.0;
  double salinity_g_per_kg = 0.0;

  friend constexpr bool operator==(const WaterPermittivity&, const WaterPermittivity&) = default;

  [[nodiscard]] std::complex<double> relative_at(double frequency_hz) const;
  /// Of the dissolved salt alone, S/m.
  [[nodiscard]] double ionic_conductivity_s_per_m() const;
};

}  // namespace sigmascape::scatter
