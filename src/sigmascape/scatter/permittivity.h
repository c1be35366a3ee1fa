#pragma once

#include <complex>
#include <variant>

#include "sigmascape/scatter/soil_permittivity.h"
#include "sigmascape/scatter/vegetation_permittivity.h"
#include "sigmascape/scatter/water_permittivity.h"

namespace sigmascape::scatter {

/// The law of ITU-R P.2040-3, Eqs. (28), (29), for building materials and ground:
///
///     ε_r = a · f^b,   σ = c · f^d [S/m],   f in GHz
///     ε = ε_r − j σ / (ω ε_0)                                docs/physics/permittivity.md, Eqs. (1), (2)
///
/// A constant relative permittivity and conductivity is the case b = d = 0.
struct PowerLawPermittivity {
  double a = 1.0;
  double b = 0.0;
  double c = 0.0;
  double d = 0.0;

  friend constexpr bool operator==(const PowerLawPermittivity&, const PowerLawPermittivity&) = default;

  [[nodiscard]] std::complex<double> relative_at(double frequency_hz) const;
};

struct FrequencyRange {
  double lowest_hz = 0.0;
  double highest_hz = 1e12;

  friend constexpr bool operator==(const FrequencyRange&, const FrequencyRange&) = default;
  [[nodiscard]] constexpr bool holds(double frequency_hz) const {
    return frequency_hz >= lowest_hz && frequency_hz <= highest_hz;
  }
};

/// How a homogeneous material answers an electric field, over frequency: one of several laws.
class Permittivity {
 public:
  using Law = std::variant<PowerLawPermittivity, WaterPermittivity, SoilPermittivity, VegetationPermittivity>;

  /// The power law with these constants; one number is a lossless material, none is vacuum.
  constexpr Permittivity(double a = 1.0, double b = 0.0, double c = 0.0, double d = 0.0)
      : law_(PowerLawPermittivity{a, b, c, d}) {}
  constexpr Permittivity(const WaterPermittivity& law) : law_(law) {}
  constexpr Permittivity(const SoilPermittivity& law) : law_(law) {}
  constexpr Permittivity(const VegetationPermittivity& law) : law_(law) {}

  /// The same relative permittivity and conductivity at all frequencies.
  [[nodiscard]] static constexpr Permittivity constant(double relative, double conductivity_s_per_m) {
    return {relative, 0.0, conductivity_s_per_m, 0.0};
  }

  friend constexpr bool operator==(const Permittivity&, const Permittivity&) = default;

  [[nodiscard]] constexpr const Law& law() const { return law_; }
  /// ε = ε' − j ε'' for time e^{jωt}.
  [[nodiscard]] std::complex<double> relative_at(double frequency_hz) const;
  /// Where the law was fitted. Power laws have no range of their own: the table that states their constants does.
  [[nodiscard]] FrequencyRange valid_frequencies() const;

 private:
  Law law_;
};

}  // namespace sigmascape::scatter
