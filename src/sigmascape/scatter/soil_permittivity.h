#pragma once

#include <complex>

namespace sigmascape::scatter {

/// Moist soil as a mixture of grains, air and bound and free water [ITU-R P.527-4, Section 5.2, after Dobson et al.
/// 1985 and Peplinski et al. 1995]. docs/physics/permittivity.md, Eqs. (7)–(10). Fitted between sandy loam (51 %
/// sand) and silty clay (47 % clay).
struct SoilPermittivity {
  double sand_percent = 40.0;
  double clay_percent = 20.0;        ///< what is neither sand nor clay is silt
  double volumetric_moisture = 0.2;  ///< water over total volume, above 0 to 0.5
  double temperature_c = 23.0;
  double specific_gravity = 2.65;  ///< of the grains

  friend constexpr bool operator==(const SoilPermittivity&, const SoilPermittivity&) = default;

  [[nodiscard]] std::complex<double> relative_at(double frequency_hz) const;
  /// Of the dry soil relative to water, by its texture.
  [[nodiscard]] double bulk_density() const;
};

}  // namespace sigmascape::scatter
