#include <fmt/format.h>
#include <fmt/ranges.h>
#include <fstream>
#include <gtest/gtest.h>
#include <set>
#include <sstream>

#include "sigmascape/base/error.h"
#include "sigmascape/base/units.h"
#include "sigmascape/scatter/material.h"

namespace sigmascape::scatter {
namespace {

/// The constants of a model in one cell of the table of docs/physics/materials.md.
struct ConstantsCell {
  std::string operator()(const LambertParameters& m) const {
    return fmt::format("`lambert`, albedo {:g}, {}", m.albedo, spread(m.depolarization));
  }
  std::string operator()(const ConstantGammaParameters& m) const {
    return fmt::format("`constant_gamma`, γ {:.3g} dB, {}", db_from_linear(m.gamma), spread(m.depolarization));
  }
  std::string operator()(const CookTorranceParameters& m) const {
    return fmt::format("`cook_torrance`, {}, α {:g}", std::visit(*this, m.permittivity.law()), m.alpha);
  }
  std::string operator()(const UlabyDobsonParameters& m) const {
    constexpr const char* classes[] = {"soil", "grass", "shrubs", "short vegetation", "dry snow", "wet snow", "trees"};
    return fmt::format("`ulaby_dobson`, {}, ρ {:g}", classes[static_cast<int>(m.terrain)],
                       m.depolarization.vv_hh_correlation);
  }
  std::string operator()(const BillingsleyParameters& m) const {
    constexpr const char* terrains[] = {"general rural", "forest", "desert"};
    return fmt::format("`billingsley`, {}, {}", terrains[static_cast<int>(m.terrain)], spread(m.depolarization));
  }
  std::string operator()(const NrlSeaParameters& m) const {
    return fmt::format("`nrl_sea`, sea state {:g}, {}", m.sea_state, spread(m.depolarization));
  }
  std::string operator()(const GitSeaParameters& m) const {
    return fmt::format("`git_sea`, sea state {:g}, {}", m.sea_state, spread(m.depolarization));
  }
  std::string operator()(const CrownParameters& m) const {
    return fmt::format("`crown`, {:g} a metre, {}", m.extinction_per_m, spread(m.depolarization));
  }
  std::string operator()(const PowerLawPermittivity& p) const {
    return fmt::format("a {:g}, b {:g}, c {:g}, d {:g}", p.a, p.b, p.c, p.d);
  }
  std::string operator()(const WaterPermittivity& p) const {
    return fmt::format("water {:g} °C, {:g} g/kg", p.temperature_c, p.salinity_g_per_kg);
  }
  std::string operator()(const SoilPermittivity& p) const {
    return fmt::format("soil {:g} % sand, {:g} % clay, moisture {:g}", p.sand_percent, p.clay_percent,
                       p.volumetric_moisture);
  }
  std::string operator()(const VegetationPermittivity& p) const {
    return fmt::format("plant, moisture {:g}", p.gravimetric_moisture);
  }
  static std::string spread(const Depolarization& d) {
    return fmt::format("x {:g}, ρ {:g}", d.cross_ratio, d.vv_hh_correlation);
  }
};

/// In GHz, with the gaps that a table leaves.
std::string frequencies_cell(const Material& material) {
  std::vector<std::string> ranges;
  for (const FrequencyRange& known : known_frequencies(material))
    ranges.push_back(fmt::format("{:g}–{:g}", known.lowest_hz / 1e9, known.highest_hz / 1e9));
  return fmt::format("{}", fmt::join(ranges, ", "));
}

std::string table_row(const Material& material) {
  return fmt::format("| `{}` | {} | {} | {} | {} |", material.name, std::visit(ConstantsCell{}, material.model),
                     frequencies_cell(material), material.verified ? "yes" : "**no**", material.source);
}

TEST(MaterialLibrary, PageListsEveryMaterialAsItIs) {
  std::ifstream file(SIGMASCAPE_SOURCE_DIR "/docs/physics/materials.md");
  std::stringstream page;
  page << file.rdbuf();
  for (const Material& material : material_library()) {
    const std::string row = table_row(material);
    EXPECT_NE(page.str().find(row), std::string::npos) << "docs/physics/materials.md lacks\n" << row;
  }
}

TEST(MaterialLibrary, NamesAreUniqueAndSourcesStated) {
  std::set<std::string> names;
  for (const Material& material : material_library()) {
    EXPECT_TRUE(names.insert(material.name).second) << material.name;
    EXPECT_FALSE(material.source.empty()) << material.name;
    EXPECT_LT(material.lowest_frequency_hz, material.highest_frequency_hz) << material.name;
  }
}

TEST(MaterialLibrary, MarksWhatNobodyChecked) {
  for (const Material& material : material_library()) {
    const bool says_so = material.source.find("not checked") != std::string::npos;
    EXPECT_EQ(says_so, !material.verified) << material.name << ": " << material.source;
  }
}

TEST(MaterialLibrary, UnknownNameListsTheKnown) {
  try {
    (void)library_material("unobtainium");
    FAIL();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("concrete"), std::string::npos);
  }
}

TEST(MaterialLibrary, LeafAtTenGigahertzIsFreshLeaf) {
  const auto& leaf = std::get<CookTorranceParameters>(library_material("leaf").model);
  EXPECT_NEAR(leaf.permittivity.relative_at(10e9).real(), 16.6, 0.05);
  EXPECT_NEAR(leaf.permittivity.relative_at(10e9).imag(), -7.4, 0.05);
}

}  // namespace
}  // namespace sigmascape::scatter
