#pragma once

#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "sigmascape/scatter/permittivity.h"

namespace sigmascape::scatter {

/// How a diffuse surface spreads power over polarizations.
struct Depolarization {
  /// Cross-polarized power over co-polarized power, linear.
  double cross_ratio = 0.1;
  /// Correlation ⟨S_VV S_HH*⟩ / ⟨|S_VV|²⟩ of the two co-polarized amplitudes, 0 to 1.
  double vv_hh_correlation = 0.5;

  friend constexpr bool operator==(const Depolarization&, const Depolarization&) = default;
};

/// Reflects the same radiance into all directions: b = ρ/π, hence σ0 = 4 ρ sin²ψ (see lambert.h). `albedo` is the part of the power
/// that leaves again, over all polarizations.
struct LambertParameters {
  double albedo = 0.5;
  Depolarization depolarization;

  friend constexpr bool operator==(const LambertParameters&, const LambertParameters&) = default;
};

/// σ0 = γ sin ψ for co-polarization (see constant_gamma.h).
struct ConstantGammaParameters {
  double gamma = 0.01;  ///< linear, at the frequency of use
  Depolarization depolarization;

  friend constexpr bool operator==(const ConstantGammaParameters&, const ConstantGammaParameters&) = default;
};

enum class MicrofacetDistribution { Beckmann, Ggx };

/// A surface of tilted mirrors (see cook_torrance.h).
struct CookTorranceParameters {
  Permittivity permittivity;
  /// Microfacet width: tan of the tilt at which Beckmann's density of slopes falls to 1/e; √2 times the rms slope along one axis.
  double alpha = 0.1;
  MicrofacetDistribution distribution = MicrofacetDistribution::Beckmann;

  friend constexpr bool operator==(const CookTorranceParameters&, const CookTorranceParameters&) = default;
};

/// What a surface is made of, as a name and one scattering model with its constants.
struct Material {
  std::string name;
  std::variant<LambertParameters, ConstantGammaParameters, CookTorranceParameters> model;
  std::string source;    ///< where the constants come from
  bool verified = true;  ///< false where no source for the constants has been seen; carried into metadata and reports
  double lowest_frequency_hz = 0.0;
  double highest_frequency_hz = 1e12;
};

/// The materials that are known by name; docs/physics/materials.md lists them with their constants and sources.
[[nodiscard]] const std::vector<Material>& material_library();

/// The library's material of that name. Throws Error, listing the known names, when there is none.
[[nodiscard]] const Material& library_material(std::string_view name);

}  // namespace sigmascape::scatter
