#include <algorithm>
#include <fmt/format.h>
#include <string>

#include "sigmascape/base/error.h"
#include "sigmascape/base/units.h"
#include "sigmascape/scatter/billingsley.h"
#include "sigmascape/scatter/git_sea.h"
#include "sigmascape/scatter/itu_p2040.h"
#include "sigmascape/scatter/material.h"
#include "sigmascape/scatter/nrl_sea.h"
#include "sigmascape/scatter/ulaby_dobson.h"

namespace sigmascape::scatter {
namespace {

// Ratios of HV to VV read off the verified C-band rows of Ulaby and Dobson at 40° of incidence: grass −6.5 dB, soil −10
// dB.
constexpr Depolarization vegetation{0.22, 0.4};
constexpr Depolarization soil{0.10, 0.7};
constexpr Depolarization smooth{0.01, 0.9};

Material mirrors(std::string name, const Permittivity& permittivity, FrequencyRange frequencies, double alpha,
                 std::string source, bool verified = true) {
  return {.name = std::move(name),
          .model = CookTorranceParameters{permittivity, alpha, MicrofacetDistribution::Beckmann},
          .source = std::move(source),
          .verified = verified,
          .lowest_frequency_hz = frequencies.lowest_hz,
          .highest_frequency_hz = frequencies.highest_hz};
}

/// The Recommendation gives no roughness: that of the paper's buildings, panes flatter and ground rougher.
double itu_alpha(std::string_view name) {
  if (name.starts_with("glass")) return 0.05;
  return name.ends_with("_ground") ? 0.3 : 0.1;
}

std::vector<Material> building_materials() {
  std::vector<Material> materials;
  for (const ItuMaterial& row : itu_p2040()) {
    const double alpha = itu_alpha(row.name);
    const std::string roughness = alpha == 0.1 ? "Visina et al., building preset" : "chosen";
    materials.push_back(mirrors(std::string(row.name), {row.law.a, row.law.b, row.law.c, row.law.d}, row.frequencies,
                                alpha, fmt::format("permittivity: {}; roughness: {}", row.source(), roughness),
                                row.verified()));
  }
  return materials;
}

/// The constants as Visina, Bergin, Kirk and Skangos publish them; near-metal at X band.
Material paper(std::string name, double relative_permittivity, double conductivity_s_per_m, double roughness) {
  return mirrors(
      std::move(name), Permittivity::constant(relative_permittivity, conductivity_s_per_m), {}, roughness,
      "Visina et al., LOD and Texture Mapping for Real-Time Radar Ground Map Simulation; roughness taken as α");
}

Material by_law(std::string name, const Permittivity& permittivity, double alpha, std::string source) {
  return mirrors(std::move(name), permittivity, permittivity.valid_frequencies(), alpha, std::move(source));
}

std::vector<Material> water_soil_and_plants() {
  const std::string water = "permittivity: ITU-R P.527-4, Section 5.1; roughness: chosen for a light breeze";
  const std::string earth = "permittivity: ITU-R P.527-4, Section 5.2, 23 °C; roughness: chosen";
  const std::string plant = "permittivity: Ulaby and El-Rayes 1987, Code 4.8 of Ulaby and Long; roughness: chosen";
  return {
      by_law("fresh_water", WaterPermittivity{20.0, 0.0}, 0.1, water),
      by_law("sea_water", WaterPermittivity{20.0, 35.0}, 0.1, water),
      by_law("sandy_loam_dry", SoilPermittivity{51.5, 13.4, 0.1}, 0.3, earth),
      by_law("sandy_loam_wet", SoilPermittivity{51.5, 13.4, 0.3}, 0.3, earth),
      by_law("loam_dry", SoilPermittivity{40.0, 20.0, 0.1}, 0.3, earth),
      by_law("loam_moist", SoilPermittivity{40.0, 20.0, 0.2}, 0.3, earth),
      by_law("loam_wet", SoilPermittivity{40.0, 20.0, 0.3}, 0.3, earth),
      by_law("silty_clay_moist", SoilPermittivity{5.0, 47.4, 0.2}, 0.3, earth),
      by_law("leaf", VegetationPermittivity{0.6}, 0.3, plant),
      by_law("leaf_drying", VegetationPermittivity{0.3}, 0.3, plant),
      mirrors("bark", Permittivity::constant(4.0, 0.5), {}, 0.6,
              "permittivity of wood between 2 and 6, not checked; roughness: Visina et al., bark", false),
  };
}

Material land(std::string name, double gamma_db, Depolarization depolarization, std::string source, bool verified) {
  return {.name = std::move(name),
          .model = ConstantGammaParameters{linear_from_db(gamma_db), depolarization},
          .source = std::move(source),
          .verified = verified,
          .lowest_frequency_hz = 1e9,
          .highest_frequency_hz = 40e9};
}

Material plants(Material material) {
  material.plants = true;
  return material;
}

std::vector<Material> constant_gamma_land() {
  const std::string quoted = "γ at 10 GHz as commonly quoted after Long and Nathanson; not checked against the books";
  const std::string barton = "γ as commonly quoted after Barton; not checked against the book";
  return {
      land("asphalt", -25.0, smooth, quoted + " (smooth)", false),
      land("flatland", -20.0, soil, "MathWorks surfaceReflectivity: −20 dB represents flatland", true),
      plants(land("grass", -15.0, vegetation, quoted + " (farmland)", false)),
      plants(land("crops", -15.0, vegetation, quoted + " (farmland)", false)),
      plants(land("shrubs", -13.0, vegetation, quoted + " (between farmland and wooded hill)", false)),
      plants(land("forest", -10.0, vegetation, quoted + " (wooded hill)", false)),
      land("forest_floor", -20.0, vegetation, "flatland (MathWorks surfaceReflectivity), shaded by its trees", true),
      land("bare_soil", -18.0, soil, quoted + " (between flatland and farmland)", false),
      land("sand", -25.0, soil, quoted + " (smooth)", false),
      land("snow", -15.0, soil, "of the order of dry snow at C band in Ulaby and Dobson; not checked at 10 GHz", false),
      land("water", -40.0, smooth,
           quoted + " (there: sea state 3; by the NRL fit: below sea state 1); calm inland water is darker still",
           false),
      land("urban", -5.0, vegetation, "Barton's urban γ by the MathWorks landreflectivity example (0.1082 at 20°)",
           true),
      plants(land("farmland", -15.0, vegetation, barton, false)),
      land("desert", -15.0, soil, barton, false),
      land("rolling_hills", -12.0, vegetation, barton, false),
      plants(land("wooded_hills", -10.0, vegetation, barton, false)),
      land("mountains", -5.0, soil, barton, false),
  };
}

struct NamedClass {
  TerrainClass terrain;
  const char* name;
  double correlation;
};

constexpr NamedClass terrain_classes[] = {
    {TerrainClass::Soil, "soil", 0.7},        {TerrainClass::Grass, "grass", 0.4},
    {TerrainClass::Shrubs, "shrubs", 0.4},    {TerrainClass::ShortVegetation, "short_vegetation", 0.4},
    {TerrainClass::DrySnow, "dry_snow", 0.7}, {TerrainClass::WetSnow, "wet_snow", 0.7},
    {TerrainClass::Trees, "trees", 0.4},
};

/// The class over its verified bands, or over those that its unverified rows add; none where it has neither.
void append_tabulated_land(std::vector<Material>& materials, const NamedClass& named, bool unverified) {
  const UlabyDobsonParameters parameters{named.terrain, unverified, {0.1, named.correlation}};
  const auto bands = ulaby_dobson_bands(parameters);
  if (bands.empty()) return;
  const std::string table = "coefficients: Ulaby and Dobson 1989, ";
  materials.push_back({.name = fmt::format("ulaby_dobson_{}{}", named.name, unverified ? "_unverified" : ""),
                       .model = parameters,
                       .source = table + (unverified ? "with rows that were not checked against the book"
                                                     : "rows as transcribed in DartsTST.jl"),
                       .plants = is_plant_cover(named.terrain),
                       .verified = !unverified,
                       .lowest_frequency_hz = bands.front().lowest_hz,
                       .highest_frequency_hz = bands.back().highest_hz});
}

Material low_angle_land(std::string name, BillingsleyTerrain terrain) {
  const FrequencyRange frequencies = billingsley_frequencies(terrain);
  return {.name = std::move(name),
          .model = BillingsleyParameters{terrain, {0.1, 0.5}},
          .source =
              "mean σ0 F⁴: Billingsley 2002, interim model, as transcribed in a public C++ implementation; "
              "cross-polarization assumed",
          .plants = is_plant_cover(terrain),
          .lowest_frequency_hz = frequencies.lowest_hz,
          .highest_frequency_hz = frequencies.highest_hz};
}

std::vector<Material> tabulated_land() {
  std::vector<Material> materials;
  for (const NamedClass& named : terrain_classes) {
    append_tabulated_land(materials, named, false);
    append_tabulated_land(materials, named, true);
  }
  materials.push_back(low_angle_land("billingsley_general_rural", BillingsleyTerrain::GeneralRural));
  materials.push_back(low_angle_land("billingsley_forest", BillingsleyTerrain::Forest));
  materials.push_back(low_angle_land("billingsley_desert", BillingsleyTerrain::Desert));
  return materials;
}

std::vector<Material> sea_states() {
  std::vector<Material> materials;
  for (int state = 0; state <= 6; ++state) {
    materials.push_back({.name = fmt::format("nrl_sea_state_{}", state),
                         .model = NrlSeaParameters{.sea_state = static_cast<double>(state)},
                         .source = "Gregers-Hansen and Mital, NRL_SigmaSea.m of 5 May 2010; cross-polarization assumed",
                         .lowest_frequency_hz = nrl_sea_frequencies.lowest_hz,
                         .highest_frequency_hz = nrl_sea_frequencies.highest_hz});
  }
  for (int state = 1; state <= 6; ++state) {
    materials.push_back({.name = fmt::format("git_sea_state_{}", state),
                         .model = GitSeaParameters{.sea_state = static_cast<double>(state)},
                         .source = "Horst, Dyer and Tuley 1978 as transcribed in three public programs, wind across "
                                   "the line of sight; cross-polarization assumed",
                         .lowest_frequency_hz = git_sea_frequencies.lowest_hz,
                         .highest_frequency_hz = git_sea_frequencies.highest_hz});
  }
  return materials;
}

std::vector<Material> made_library() {
  std::vector<Material> library{
      mirrors("ideal_conductor", Permittivity::constant(1.0, 1e9), {}, 0.01,
              "conductivity beyond any metal; α = 0.01 keeps it traceable"),
      paper("paper_building", 1e5, 1e5, 0.1),
      paper("paper_leaf", 50.0, 1e2, 0.08),
      paper("paper_bark", 200.0, 5e-3, 0.6),
  };
  for (auto&& part :
       {building_materials(), water_soil_and_plants(), constant_gamma_land(), tabulated_land(), sea_states()})
    library.insert(library.end(), part.begin(), part.end());
  return library;
}

}  // namespace

bool is_plant_cover(TerrainClass terrain) {
  return terrain == TerrainClass::Grass || terrain == TerrainClass::Shrubs ||
         terrain == TerrainClass::ShortVegetation || terrain == TerrainClass::Trees;
}

bool is_plant_cover(BillingsleyTerrain terrain) {
  return terrain != BillingsleyTerrain::Desert;
}

const std::vector<Material>& material_library() {
  static const std::vector<Material> library = made_library();
  return library;
}

const Material& library_material(std::string_view name) {
  const auto& library = material_library();
  const auto found = std::ranges::find(library, name, &Material::name);
  if (found != library.end()) return *found;
  std::string known;
  for (const Material& material : library) known += (known.empty() ? "" : ", ") + material.name;
  throw Error("material " + std::string(name), "is not in the library", "use one of: " + known);
}

}  // namespace sigmascape::scatter
