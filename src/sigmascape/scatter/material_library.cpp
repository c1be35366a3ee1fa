#include <algorithm>
#include <string>

#include "sigmascape/base/error.h"
#include "sigmascape/base/units.h"
#include "sigmascape/scatter/material.h"

namespace sigmascape::scatter {
namespace {

/// A building material of ITU-R P.2040-3, Table 3. The Recommendation gives no roughness; α = 0.1 is the paper's for buildings.
Material itu(std::string name, Permittivity permittivity, double highest_ghz, double alpha = 0.1) {
  return {.name = std::move(name),
          .model = CookTorranceParameters{permittivity, alpha, MicrofacetDistribution::Beckmann},
          .source = "permittivity: ITU-R P.2040-3, Table 3; roughness: Visina et al., building preset",
          .lowest_frequency_hz = 1e9,
          .highest_frequency_hz = highest_ghz * 1e9};
}

/// The constants as Visina, Bergin, Kirk and Skangos publish them; near-metal at X band.
Material paper(std::string name, double relative_permittivity, double conductivity_s_per_m, double roughness) {
  return {.name = std::move(name),
          .model = CookTorranceParameters{{relative_permittivity, 0.0, conductivity_s_per_m, 0.0}, roughness,
                                          MicrofacetDistribution::Beckmann},
          .source = "Visina et al., LOD and Texture Mapping for Real-Time Radar Ground Map Simulation; roughness taken as α"};
}

Material land(std::string name, double gamma_db, Depolarization depolarization, std::string source, bool verified) {
  return {.name = std::move(name),
          .model = ConstantGammaParameters{linear_from_db(gamma_db), depolarization},
          .source = std::move(source),
          .verified = verified,
          .lowest_frequency_hz = 1e9,
          .highest_frequency_hz = 40e9};
}

std::vector<Material> made_library() {
  // Ratios of HV to VV read off the verified C-band rows of Ulaby and Dobson at 40° of incidence: grass −6.5 dB, soil −10 dB.
  const Depolarization vegetation{0.22, 0.4};
  const Depolarization soil{0.10, 0.7};
  const Depolarization smooth{0.01, 0.9};
  const std::string quoted = "γ at 10 GHz as commonly quoted after Long and Nathanson; not checked against the books";

  return {
      {.name = "ideal_conductor",
       .model = CookTorranceParameters{{1.0, 0.0, 1e9, 0.0}, 0.01, MicrofacetDistribution::Beckmann},
       .source = "conductivity beyond any metal; α = 0.01 keeps it traceable"},
      itu("concrete", {5.24, 0.0, 0.0462, 0.7822}, 100.0),
      itu("brick", {3.91, 0.0, 0.0238, 0.16}, 40.0),
      itu("wood", {1.99, 0.0, 0.0047, 1.0718}, 100.0),
      itu("glass", {6.31, 0.0, 0.0036, 1.3394}, 100.0, 0.05),
      itu("marble", {7.074, 0.0, 0.0055, 0.9262}, 60.0),
      itu("metal", {1.0, 0.0, 1e7, 0.0}, 100.0),
      paper("paper_building", 1e5, 1e5, 0.1),
      paper("paper_leaf", 50.0, 1e2, 0.08),
      paper("paper_bark", 200.0, 5e-3, 0.6),
      // Fresh leaves of gravimetric moisture 0.6 at 10 GHz: ε = 16.6 − j 7.4, written as the conductivity that gives this loss.
      {.name = "leaf",
       .model = CookTorranceParameters{{16.6, 0.0, 4.117, 0.0}, 0.3, MicrofacetDistribution::Beckmann},
       .source = "permittivity: Ulaby and El-Rayes dual-dispersion model, moisture 0.6, 10 GHz; roughness chosen",
       .lowest_frequency_hz = 8e9,
       .highest_frequency_hz = 12e9},
      {.name = "bark",
       .model = CookTorranceParameters{{4.0, 0.0, 0.5, 0.0}, 0.6, MicrofacetDistribution::Beckmann},
       .source = "permittivity of wood between 2 and 6, not checked; roughness: Visina et al., bark",
       .verified = false},
      land("asphalt", -25.0, smooth, quoted + " (smooth)", false),
      land("flatland", -20.0, soil, "MathWorks surfaceReflectivity: −20 dB represents flatland", true),
      land("grass", -15.0, vegetation, quoted + " (farmland)", false),
      land("crops", -15.0, vegetation, quoted + " (farmland)", false),
      land("shrubs", -13.0, vegetation, quoted + " (between farmland and wooded hill)", false),
      land("forest", -10.0, vegetation, quoted + " (wooded hill)", false),
      land("forest_floor", -20.0, vegetation, "flatland (MathWorks surfaceReflectivity), shaded by its trees", true),
      land("bare_soil", -18.0, soil, quoted + " (between flatland and farmland)", false),
      land("sand", -25.0, soil, quoted + " (smooth)", false),
      land("snow", -15.0, soil, "of the order of dry snow at C band in Ulaby and Dobson; not checked at 10 GHz", false),
      land("water", -40.0, smooth, quoted + " (sea state 3); calm inland water is darker still", false),
      land("urban", -5.0, vegetation, "Barton's urban γ by the MathWorks landreflectivity example (0.1082 at 20°)", true),
  };
}

}  // namespace

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
