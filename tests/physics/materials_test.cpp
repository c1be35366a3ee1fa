#include <algorithm>
#include <complex>
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "physics/normal_reflectivity.h"
#include "validation/validation_record.h"

#include "sigmascape/base/error.h"
#include "sigmascape/base/units.h"
#include "sigmascape/scatter/itu_p2040.h"
#include "sigmascape/scatter/surface_model.h"

namespace sigmascape::physics_test {
namespace {

std::complex<double> permittivity_of(const char* material, double frequency_hz) {
  const auto& model = std::get<scatter::CookTorranceParameters>(scatter::library_material(material).model);
  return model.permittivity.relative_at(frequency_hz);
}

struct Reflectivity {
  const char* material;
  double frequency_hz;
  double expected;
};

TEST(Materials, NormalReflectivity) {
  const Reflectivity rows[] = {
      {"concrete", 10e9, 0.1549},
      {"brick", 10e9, 0.1078},
      {"wood", 10e9, 0.0293},
      {"glass", 10e9, 0.1854},
      {"metal", 10e9, 0.9993},
      {"asphalt_concrete", 10e9, 0.1417},
      {"marble", 10e9, 0.2057},
      {"very_dry_ground", 10e9, 0.0719},
      {"medium_dry_ground", 10e9, 0.3108},
      {"wet_ground", 10e9, 0.3316},
      {"plasterboard", 10e9, 0.0608},
      {"chipboard", 10e9, 0.0551},
      {"plywood", 10e9, 0.0652},
      {"ceiling_board", 10e9, 0.0096},
      {"floorboard", 60e9, 0.0993},
      {"glass_220_ghz", 300e9, 0.1708},
      {"ceiling_board_220_ghz", 300e9, 0.0110},
      {"vinyl_tile", 10e9, 0.0967},
      {"carpet_tile", 10e9, 0.0328},
      {"concrete_110_ghz", 300e9, 0.1524},
      {"brick_110_ghz", 300e9, 0.1172},
      {"medium_dry_ground", 1.3e9, 0.3429},
      {"wet_ground", 1.3e9, 0.4603},
      {"paper_building", 10e9, 0.9924},
      {"paper_leaf", 10e9, 0.7922},
      {"paper_bark", 10e9, 0.7533},
      {"paper_building", 1.3e9, 0.9975},
      {"paper_leaf", 1.3e9, 0.9255},
      {"paper_bark", 1.3e9, 0.7533},
      {"paper_building", 35e9, 0.9885},
      {"paper_leaf", 35e9, 0.6466},
      {"paper_bark", 35e9, 0.7533},
  };
  for (const Reflectivity& row : rows) {
    validation::expect_close({.group = "Materials",
                              .name = fmt::format("{}, |R(0)|² at {} GHz", row.material, row.frequency_hz / 1e9),
                              .expected = row.expected,
                              .measured = normal_reflectivity(permittivity_of(row.material, row.frequency_hz)),
                              .tolerance = 6e-5,
                              .unit = "1",
                              .source = "constants of the source evaluated independently"});
  }
}

TEST(Materials, LossOfThePapersMaterials) {
  // ε'' = σ/(ω ε₀) at 10 GHz.
  EXPECT_NEAR(-permittivity_of("paper_building", 10e9).imag(), 1.80e5, 0.005e5);
  EXPECT_NEAR(-permittivity_of("paper_leaf", 10e9).imag(), 179.8, 0.05);
  EXPECT_NEAR(-permittivity_of("paper_bark", 10e9).imag(), 0.009, 5e-4);
}

struct Loss {
  const char* material;
  double f_ghz;
  double expected;  // ε''
};

// |R(0)|² hardly knows of a loss like these. At two frequencies: one for c, both for d.
TEST(Materials, LossOfTheRecommendation) {
  const Loss rows[] = {
      {"concrete", 2.0, 0.7141},
      {"concrete", 10.0, 0.5029},
      {"brick", 2.0, 0.2390},
      {"brick", 10.0, 0.0618},
      {"plasterboard", 2.0, 0.1465},
      {"plasterboard", 10.0, 0.1329},
      {"wood", 2.0, 0.0888},
      {"wood", 10.0, 0.0997},
      {"glass", 2.0, 0.0819},
      {"glass", 10.0, 0.1414},
      {"glass_220_ghz", 220.0, 0.2501},
      {"glass_220_ghz", 300.0, 0.3067},
      {"ceiling_board", 2.0, 0.0208},
      {"ceiling_board", 10.0, 0.0235},
      {"ceiling_board_220_ghz", 220.0, 0.0610},
      {"ceiling_board_220_ghz", 300.0, 0.0615},
      {"chipboard", 2.0, 0.3349},
      {"chipboard", 10.0, 0.2350},
      {"plywood", 2.0, 2.9659},
      {"plywood", 10.0, 0.5932},
      {"marble", 2.0, 0.0939},
      {"marble", 10.0, 0.0834},
      {"floorboard", 60.0, 0.3335},
      {"floorboard", 100.0, 0.3991},
      {"very_dry_ground", 2.0, 0.0077},
      {"very_dry_ground", 10.0, 0.0893},
      {"medium_dry_ground", 2.0, 0.9736},
      {"medium_dry_ground", 10.0, 2.6837},
      {"wet_ground", 2.0, 3.3195},
      {"wet_ground", 10.0, 5.3798},
      {"asphalt_concrete", 2.0, 0.2556},
      {"asphalt_concrete", 10.0, 0.4842},
      {"vinyl_tile", 2.0, 0.0822},
      {"vinyl_tile", 10.0, 0.0637},
      {"carpet_tile", 2.0, 0.0143},
      {"carpet_tile", 10.0, 0.0107},
      {"concrete_110_ghz", 110.0, 0.3979},
      {"concrete_110_ghz", 300.0, 0.4355},
      {"brick_110_ghz", 110.0, 0.1581},
      {"brick_110_ghz", 300.0, 0.2804},
  };
  for (const Loss& row : rows) {
    validation::expect_close({.group = "Materials",
                              .name = fmt::format("{}, ε'' at {} GHz", row.material, row.f_ghz),
                              .expected = row.expected,
                              .measured = -permittivity_of(row.material, row.f_ghz * 1e9).imag(),
                              .tolerance = 6e-5,
                              .unit = "1",
                              .source = "c f^d/(ω ε₀) of ITU-R P.2040 evaluated independently"});
  }
}

TEST(Materials, EveryRowOfTheRecommendationIsThere) {
  for (const scatter::ItuMaterial& row : scatter::itu_p2040()) {
    const scatter::Material& material = scatter::library_material(row.name);
    const auto& mirrors = std::get<scatter::CookTorranceParameters>(material.model);
    EXPECT_EQ(std::get<scatter::PowerLawPermittivity>(mirrors.permittivity.law()), row.law) << row.name;
    EXPECT_EQ(material.lowest_frequency_hz, row.frequencies.lowest_hz) << row.name;
    EXPECT_EQ(material.highest_frequency_hz, row.frequencies.highest_hz) << row.name;
    EXPECT_EQ(material.verified, row.verified()) << row.name;
  }
  EXPECT_EQ(std::ranges::count_if(scatter::itu_p2040(), &scatter::ItuMaterial::verified), 16);
}

TEST(Materials, AreRefusedOutsideTheirFrequencies) {
  for (const scatter::Material& material : scatter::material_library()) {
    EXPECT_THROW((scatter::SurfaceModel{material, material.highest_frequency_hz * 1.01}), Error) << material.name;
    if (material.lowest_frequency_hz > 0.0) {
      EXPECT_THROW((scatter::SurfaceModel{material, material.lowest_frequency_hz * 0.99}), Error) << material.name;
      EXPECT_NO_THROW((scatter::SurfaceModel{material, material.lowest_frequency_hz})) << material.name;
    }
    EXPECT_NO_THROW((scatter::SurfaceModel{material, material.highest_frequency_hz})) << material.name;
  }
}

// A model's own limits hold for materials of a user's making, which state none.
TEST(Materials, ModelsKeepTheirOwnFrequencies) {
  const auto refused = [](const scatter::Material::Model& parameters, double frequency_hz) {
    try {
      const scatter::SurfaceModel model({.name = "own", .model = parameters, .source = {}}, frequency_hz);
      return false;
    } catch (const Error&) {
      return true;
    }
  };
  EXPECT_TRUE(refused(scatter::NrlSeaParameters{}, 40e9));
  EXPECT_FALSE(refused(scatter::NrlSeaParameters{}, 34e9));
  EXPECT_TRUE(refused(scatter::GitSeaParameters{}, 16e9));
  EXPECT_TRUE(refused(scatter::BillingsleyParameters{scatter::BillingsleyTerrain::Desert, {}}, 1e9));
  EXPECT_TRUE(refused(scatter::UlabyDobsonParameters{.terrain = scatter::TerrainClass::Shrubs}, 3e9));
  EXPECT_TRUE(refused(scatter::CookTorranceParameters{.permittivity = scatter::VegetationPermittivity{}}, 35e9));
  EXPECT_TRUE(refused(scatter::CookTorranceParameters{.permittivity = scatter::SoilPermittivity{}}, 94e9));
}

// Vacuum has the least permittivity, and what does not amplify a conductivity that is not negative.
TEST(Materials, WhosePermittivityNothingHasAreRefused) {
  const auto refusal = [](const scatter::Material::Model& parameters) -> std::string {
    try {
      const scatter::SurfaceModel model({.name = "own", .model = parameters, .source = {}}, 9e9);
      return "";
    } catch (const Error& error) {
      return error.what();
    }
  };
  const auto mirrors = [&](double a, double b, double c, double d) {
    return refusal(scatter::CookTorranceParameters{.permittivity = {a, b, c, d}});
  };
  EXPECT_EQ(mirrors(1.0, 0.0, 0.0, 0.0), "");
  EXPECT_EQ(mirrors(30.0, -0.4, 0.15, 1.3), "");
  EXPECT_EQ(mirrors(1.0, 0.0, 1e9, 0.0), "");
  EXPECT_NE(mirrors(0.0, 0.0, 0.0, 0.0), "");
  EXPECT_NE(mirrors(-5.0, 0.0, 0.0, 0.0), "");
  EXPECT_NE(mirrors(5.0, 0.0, 1.0, 1e9), "");
  EXPECT_NE(mirrors(5.0, -1.0, 0.0, 0.0), "");
  // σ/(ω ε₀) of −1 S/m at 9 GHz.
  const std::string amplifier = mirrors(5.0, 0.0, -1.0, 0.0);
  EXPECT_NE(amplifier.find("own"), std::string::npos) << amplifier;
  EXPECT_NE(amplifier.find("9 GHz is 5 with a loss of -1.997"), std::string::npos) << amplifier;

  scatter::CrownParameters crown;
  crown.leaf = scatter::Permittivity{0.5};
  EXPECT_NE(refusal(crown), "");
  crown.leaf = scatter::Permittivity{20.0};
  EXPECT_EQ(refusal(crown), "");
}

TEST(Materials, ThatReturnMoreThanArrivesAreRefused) {
  const auto white = [](double albedo) {
    return scatter::SurfaceModel({.name = "own", .model = scatter::LambertParameters{albedo, {}}, .source = {}}, 9e9);
  };
  EXPECT_NO_THROW((void)white(1.0));
  EXPECT_THROW((void)white(1.1), Error);

  scatter::CrownParameters crown{.albedo = 1.1};
  const auto leaves = [&] { return scatter::SurfaceModel({.name = "own", .model = crown, .source = {}}, 9e9); };
  EXPECT_THROW((void)leaves(), Error);
  // What mirrors return, their permittivity decides.
  crown.leaf = scatter::Permittivity{20.0};
  EXPECT_NO_THROW((void)leaves());
}

TEST(Materials, KnownFrequenciesShowTheGapOfShrubs) {
  const auto known = scatter::known_frequencies(scatter::library_material("ulaby_dobson_shrubs"));
  ASSERT_EQ(known.size(), 2U);
  EXPECT_EQ(known[0], (scatter::FrequencyRange{1e9, 2e9}));
  EXPECT_EQ(known[1], (scatter::FrequencyRange{4e9, 8e9}));
  // Bands that meet are one range.
  EXPECT_EQ(scatter::known_frequencies(scatter::library_material("ulaby_dobson_soil")).size(), 1U);
}

TEST(Materials, RefusalSaysWhichAndWhatWouldBeRight) {
  try {
    const scatter::SurfaceModel model(scatter::library_material("wet_ground"), 35e9);
    FAIL() << "wet_ground is known from 1 to 10 GHz only";
  } catch (const Error& error) {
    const std::string message = error.what();
    EXPECT_NE(message.find("wet_ground"), std::string::npos) << message;
    EXPECT_NE(message.find("1 to 10 GHz"), std::string::npos) << message;
  }
}

}  // namespace
}  // namespace sigmascape::physics_test
