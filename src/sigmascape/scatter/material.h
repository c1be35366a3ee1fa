#pragma once

#include <numbers>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "sigmascape/scatter/permittivity.h"

namespace sigmascape::scatter {

/// How a diffuse surface spreads power over polarizations.
struct Depolarization {
  /// Cross-polarized power over co-polarized power (their geometric mean where VV and HH differ), linear. Models whose
  /// tables hold cross-polarization do without it.
  double cross_ratio = 0.1;
  /// Correlation ⟨S_VV S_HH*⟩ / √(⟨|S_VV|²⟩ ⟨|S_HH|²⟩) of the two co-polarized amplitudes, 0 to 1.
  double vv_hh_correlation = 0.5;

  friend constexpr bool operator==(const Depolarization&, const Depolarization&) = default;
};

/// Reflects the same radiance into all directions: b = ρ/π, hence σ0 = 4 ρ sin²ψ (see lambert.h). `albedo` is the part
/// of the power that leaves again, over all polarizations.
struct LambertParameters {
  double albedo = 0.5;
  Depolarization depolarization{};

  friend constexpr bool operator==(const LambertParameters&, const LambertParameters&) = default;
};

enum class GammaFrequencyLaw {
  AsStated,            ///< γ is that of the frequency of use
  SquareRootFrom10Ghz  ///< γ is that of 10 GHz and goes with √f, 5 dB a decade. Not verified.
};

/// σ0 = γ sin ψ for co-polarization (see constant_gamma.h).
struct ConstantGammaParameters {
  double gamma = 0.01;  ///< linear
  Depolarization depolarization{};
  GammaFrequencyLaw frequency_law = GammaFrequencyLaw::AsStated;

  friend constexpr bool operator==(const ConstantGammaParameters&, const ConstantGammaParameters&) = default;
};

enum class TerrainClass { Soil, Grass, Shrubs, ShortVegetation, DrySnow, WetSnow, Trees };

/// Measured mean σ0 of natural ground over incidence, band and polarization (see ulaby_dobson.h).
struct UlabyDobsonParameters {
  TerrainClass terrain = TerrainClass::Grass;
  /// Falls back on rows whose coefficients were never checked against the book, where there is no verified one.
  bool unverified_rows = false;
  /// Its cross ratio serves only where the table has no row for cross-polarization.
  Depolarization depolarization{};

  friend constexpr bool operator==(const UlabyDobsonParameters&, const UlabyDobsonParameters&) = default;
};

enum class BillingsleyTerrain { GeneralRural, Forest, Desert };

/// Mean strength of land clutter at low angles (see billingsley.h).
struct BillingsleyParameters {
  BillingsleyTerrain terrain = BillingsleyTerrain::GeneralRural;
  Depolarization depolarization{};

  friend constexpr bool operator==(const BillingsleyParameters&, const BillingsleyParameters&) = default;
};

/// Mean σ0 of the sea by the Naval Research Laboratory's fit (see nrl_sea.h).
struct NrlSeaParameters {
  double sea_state = 3.0;  ///< Douglas, 0 to 6
  Depolarization depolarization{0.01, 0.5};

  friend constexpr bool operator==(const NrlSeaParameters&, const NrlSeaParameters&) = default;
};

/// Mean σ0 of the sea at low grazing angles by the Georgia Tech model (see git_sea.h).
struct GitSeaParameters {
  double sea_state = 3.0;  ///< Douglas, 1 to 6
  /// Angle between where the wind comes from and the radar: 0 looks upwind, π/2 across.
  double wind_angle_rad = std::numbers::pi / 2.0;
  /// At 0, the wind of a fully risen sea.
  double wind_speed_mps = 0.0;
  Depolarization depolarization{0.01, 0.5};

  friend constexpr bool operator==(const GitSeaParameters&, const GitSeaParameters&) = default;
};

enum class MicrofacetDistribution { Beckmann, Ggx };

/// How the facets that two directions see depend on one another.
enum class Masking {
  Correlated,        ///< by height and azimuth [Heitz 2014, Eq. 101]; right in backscatter
  HeightCorrelated,  ///< by height alone [Heitz 2014, Eq. 99]: G2 = 1 / (1 + Λi + Λo). For comparison with published
                     ///< numbers only.
  Separable,  ///< not at all: G2 = G1 G1, up to 1.7 dB low in backscatter. For comparison with published numbers only.
};

/// A surface of tilted mirrors (see cook_torrance.h).
struct CookTorranceParameters {
  Permittivity permittivity;
  /// Microfacet width: tan of the tilt at which Beckmann's density of slopes falls to 1/e; √2 times the rms slope along
  /// one axis.
  double alpha = 0.1;
  MicrofacetDistribution distribution = MicrofacetDistribution::Beckmann;
  /// Scattering coefficient S: the part S² of the reflected power that leaves diffusely, as from walls with windows,
  /// sills and balconies too small to be modelled; 1 − S² stays in the lobe of the mirrors.
  double scattering_coefficient = 0.0;
  Depolarization depolarization{0.1, 0.5};  ///< of the diffuse part
  Masking masking = Masking::Correlated;
  /// Adds what facets pass on to one another (see multiple_scatter.h). Off by default: it raises single-bounce σ0 above
  /// geometric optics.
  bool multiple_scatter = false;

  friend constexpr bool operator==(const CookTorranceParameters&, const CookTorranceParameters&) = default;
};

/// The leaves of a tree crown as a medium (see crown_medium.h). No surface is made of it.
struct CrownParameters {
  double extinction_per_m = 0.5;  ///< κ: the part of power that is intercepted along one metre, at all frequencies
  double albedo = 0.5;  ///< part of what is intercepted that leaves again; not that of `leaf` when that is stated
  /// When stated, leaves are flat mirrors of this permittivity turned every way.
  std::optional<Permittivity> leaf = {};
  /// What passes between the leaves on its way in comes back the same way, as between leaves of a mesh. Without it, the
  /// way back weakens a direct echo once more, as in media of scatterers smaller than a wavelength.
  bool shares_gaps = true;
  Depolarization depolarization{0.1, 0.5};  ///< of leaves that are not stated as mirrors

  /// By which echoes from beyond fall off, the way there and back together.
  [[nodiscard]] constexpr double two_way_extinction_per_m() const {
    return shares_gaps ? extinction_per_m : 2.0 * extinction_per_m;
  }

  friend constexpr bool operator==(const CrownParameters&, const CrownParameters&) = default;
};

/// What a surface is made of, as a name and one scattering model with its constants.
struct Material {
  using Model = std::variant<LambertParameters, ConstantGammaParameters, CookTorranceParameters, UlabyDobsonParameters,
                             BillingsleyParameters, NrlSeaParameters, GitSeaParameters, CrownParameters>;

  std::string name;
  Model model;
  std::string source;    ///< where the constants come from
  bool plants = false;   ///< whether it stands for plants, which wind moves, and not what lies beneath trees
  bool verified = true;  ///< false where no source for the constants has been seen; carried into metadata and reports
  double lowest_frequency_hz = 0.0;
  double highest_frequency_hz = 1e12;

  /// Of tree crowns: no surface is made of it.
  [[nodiscard]] bool is_medium() const { return std::holds_alternative<CrownParameters>(model); }
};

/// Where a material's constants hold: its own limits and those of its model or law of permittivity together, from low
/// to high. More than one range where a table lacks a band between two others; none where both contradict one another.
[[nodiscard]] std::vector<FrequencyRange> known_frequencies(const Material& material);

/// The materials that are known by name; docs/physics/materials.md lists them with their constants and sources.
[[nodiscard]] const std::vector<Material>& material_library();

/// Whether such ground is a cover of plants.
[[nodiscard]] bool is_plant_cover(TerrainClass terrain);
[[nodiscard]] bool is_plant_cover(BillingsleyTerrain terrain);

/// The library's material of that name. Throws Error, listing the known names, when there is none.
[[nodiscard]] const Material& library_material(std::string_view name);

}  // namespace sigmascape::scatter
