#include "sigmascape/scene/material_reader.h"

#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "scratch_folder.h"

#include "sigmascape/base/error.h"
#include "sigmascape/base/units.h"
#include "sigmascape/scatter/surface_model.h"

namespace sigmascape::scene {
namespace {

using ::testing::HasSubstr;

class MaterialReader : public testing::Test {
 protected:
  /// The material `own` of a scene file with these lines in its section.
  scatter::Material read(const std::string& lines) {
    const auto file = folder_.write("scene.toml", "[materials.own]\n" + lines);
    return MaterialTable(TomlSection::read_file(file)).material("own", "test");
  }

  template <typename Parameters>
  Parameters model(const std::string& lines) {
    return std::get<Parameters>(read(lines).model);
  }

  ScratchFolder folder_;
};

TEST_F(MaterialReader, UlabyDobson) {
  const auto land = model<scatter::UlabyDobsonParameters>(
      "model = \"ulaby_dobson\"\nterrain = \"dry_snow\"\nvv_hh_correlation = 0.6\n");
  EXPECT_EQ(land.terrain, scatter::TerrainClass::DrySnow);
  EXPECT_FALSE(land.unverified_rows);
  EXPECT_EQ(land.depolarization.vv_hh_correlation, 0.6);
}

TEST_F(MaterialReader, UnverifiedCoefficientsMarkTheMaterial) {
  EXPECT_TRUE(read("model = \"ulaby_dobson\"\nterrain = \"grass\"\n").verified);
  EXPECT_FALSE(read("model = \"ulaby_dobson\"\nterrain = \"grass\"\nunverified_rows = true\n").verified);
  EXPECT_FALSE(read("base = \"flatland\"\nfrequency_law = \"square_root_from_10_ghz\"\n").verified);
  EXPECT_TRUE(read("base = \"flatland\"\n").verified);
  // What a base's constants are worth says nothing of others in their place.
  EXPECT_TRUE(read("base = \"ulaby_dobson_grass_unverified\"\nunverified_rows = false\n").verified);
  EXPECT_FALSE(read("base = \"bark\"\nalpha = 0.3\n").verified);
  EXPECT_TRUE(read("base = \"bark\"\npermittivity = 5\nalpha = 0.3\n").verified);
}

// The base knows C band at most; with unverified rows the material reaches as far as they do.
TEST_F(MaterialReader, FrequenciesFollowTheRows) {
  const auto own = read("base = \"ulaby_dobson_grass\"\nunverified_rows = true\n");
  EXPECT_EQ(scatter::known_frequencies(own).back().highest_hz, 40e9);
}

TEST_F(MaterialReader, MaskingAndMultipleScatterOfMirrors) {
  const std::string mirrors = "model = \"cook_torrance\"\npermittivity = 5\nalpha = 0.6\n";
  const auto plain = model<scatter::CookTorranceParameters>(mirrors);
  EXPECT_EQ(plain.masking, scatter::Masking::Correlated);
  EXPECT_FALSE(plain.multiple_scatter);
  const auto own = model<scatter::CookTorranceParameters>(mirrors + "masking = \"separable\"\nmulti_scatter = true\n");
  EXPECT_EQ(own.masking, scatter::Masking::Separable);
  EXPECT_TRUE(own.multiple_scatter);
  EXPECT_THROW(read(mirrors + "masking = \"tall\"\n"), Error);
}

// What the keys state arrives in the model: separable masking takes power from slanting backscatter, multiple
// scattering brings cross-polarization that single reflection lacks.
TEST_F(MaterialReader, MaskingAndMultipleScatterReachTheModel) {
  const std::string mirrors = "model = \"cook_torrance\"\ndistribution = \"ggx\"\npermittivity = 50\nalpha = 0.6\n";
  const auto backscatter = [&](const std::string& lines) {
    return scatter::SurfaceModel(read(mirrors + lines), 10e9).backscatter({0.8F, 0.0F, 0.6F}, Vec3f{0.0F, 0.0F, 1.0F});
  };
  const radar::Channels plain = backscatter("");
  EXPECT_LT(backscatter("masking = \"separable\"\n").vv, 0.95F * plain.vv);
  EXPECT_EQ(plain.hv, 0.0F);
  EXPECT_GT(backscatter("multi_scatter = true\n").hv, 0.0F);
}

TEST_F(MaterialReader, BillingsleyAndSeas) {
  EXPECT_EQ(model<scatter::BillingsleyParameters>("model = \"billingsley\"\nterrain = \"desert\"\n").terrain,
            scatter::BillingsleyTerrain::Desert);
  EXPECT_EQ(model<scatter::NrlSeaParameters>("model = \"nrl_sea\"\nsea_state = 4.5\n").sea_state, 4.5);
  const auto sea = model<scatter::GitSeaParameters>(
      "model = \"git_sea\"\nsea_state = 2\nwind_angle_deg = 180\nwind_speed_mps = 9\n");
  EXPECT_EQ(sea.sea_state, 2.0);
  EXPECT_NEAR(sea.wind_angle_rad, pi, 1e-12);
  EXPECT_EQ(sea.wind_speed_mps, 9.0);
  EXPECT_THROW(read("model = \"git_sea\"\nsea_state = 0\n"), Error);
  EXPECT_THROW(read("model = \"nrl_sea\"\nterrain = \"soil\"\n"), Error);
}

TEST_F(MaterialReader, PermittivityInEveryWay) {
  const auto at_10_ghz = [&](const std::string& lines) {
    return model<scatter::CookTorranceParameters>("model = \"cook_torrance\"\n" + lines).permittivity.relative_at(10e9);
  };
  EXPECT_NEAR(at_10_ghz("permittivity = 4\nconductivity_s_per_m = 0.5\n").imag(), -0.899, 1e-3);
  EXPECT_NEAR(at_10_ghz("permittivity_law = [15, -0.1, 0.035, 1.63]\n").real(), 15.0 * std::pow(10.0, -0.1), 1e-9);
  EXPECT_NEAR(at_10_ghz("water = {temperature_c = 20, salinity_g_per_kg = 35}\n").real(), 56.03, 0.005);
  EXPECT_NEAR(at_10_ghz("soil = {sand_percent = 40, clay_percent = 20, moisture = 0.2}\n").real(), 10.44, 0.005);
  EXPECT_NEAR(at_10_ghz("plant = {moisture = 0.6}\n").real(), 16.6, 0.05);
}

TEST_F(MaterialReader, PermittivityIsStatedOnce) {
  EXPECT_THROW(read("model = \"cook_torrance\"\npermittivity = 4\nwater = {}\n"), Error);
  EXPECT_THROW(read("model = \"cook_torrance\"\npermittivity_law = [1, 2, 3]\n"), Error);
  EXPECT_THROW(read("model = \"cook_torrance\"\nsoil = {sand_percent = 60, clay_percent = 40}\n"), Error);
  EXPECT_THROW(read("model = \"cook_torrance\"\nplant = {humidity = 0.6}\n"), Error);
}

// Of vacuum nothing is reflected, and nobody asks for that by saying nothing.
TEST_F(MaterialReader, MirrorsSayWhatTheyAreOf) {
  EXPECT_THROW(read("model = \"cook_torrance\"\nalpha = 0.3\n"), Error);
  EXPECT_THROW(read("model = \"cook_torrance\"\nconductivity_s_per_m = 5\n"), Error);
  EXPECT_THROW(read("base = \"sea_water\"\nconductivity_s_per_m = 5\n"), Error);
  EXPECT_NO_THROW(read("base = \"concrete\"\nconductivity_s_per_m = 0.5\n"));
  EXPECT_NO_THROW(read("base = \"metal\"\nconductivity_s_per_m = 1e6\n"));
}

TEST_F(MaterialReader, WhatIsNotSaidStaysTheBases) {
  const auto at_10_ghz = [&](const std::string& lines) {
    return model<scatter::CookTorranceParameters>(lines).permittivity.relative_at(10e9);
  };
  EXPECT_NEAR(at_10_ghz("base = \"leaf_drying\"\nplant = {salinity_g_per_kg = 20}\n").real(), 5.7, 0.2);
  EXPECT_NEAR(at_10_ghz("base = \"sandy_loam_dry\"\nsoil = {temperature_c = 10}\n").real(), 6.3, 0.2);
  const auto cold_sea = model<scatter::CookTorranceParameters>("base = \"sea_water\"\nwater = {temperature_c = 5}\n");
  EXPECT_EQ(cold_sea.permittivity, scatter::Permittivity(scatter::WaterPermittivity{5.0, 35.0}));
}

TEST_F(MaterialReader, DepolarizationOfNothingDiffuseIsRefused) {
  const std::string crown = "model = \"crown\"\nextinction_db_per_m = 2\n";
  for (const char* key : {"cross_ratio_db = -6\n", "vv_hh_correlation = 0.5\n"}) {
    const auto said_of = [&](const std::string& lines) {
      return message_of_error([&] { static_cast<void>(read(lines + key)); });
    };
    EXPECT_THAT(said_of("base = \"leaf\"\n"), HasSubstr("means nothing without a scattering_coefficient"));
    EXPECT_THAT(said_of(crown + "permittivity = 20\n"), HasSubstr("means nothing beside the permittivity"));
    EXPECT_EQ(said_of("base = \"leaf\"\nscattering_coefficient = 0.5\n"), "");
    EXPECT_THAT(said_of(crown), HasSubstr("is the medium of a tree's crown")) << "read, but no surface";
  }
}

TEST_F(MaterialReader, PlantsAreWhatTheBaseIsOrTheSectionSays) {
  EXPECT_TRUE(read("base = \"crops\"\n").plants);
  EXPECT_FALSE(read("base = \"asphalt\"\n").plants);
  EXPECT_FALSE(read("base = \"forest_floor\"\n").plants);
  EXPECT_TRUE(read("model = \"ulaby_dobson\"\nterrain = \"trees\"\n").plants);
  EXPECT_FALSE(read("base = \"billingsley_forest\"\nterrain = \"desert\"\n").plants);
  EXPECT_TRUE(read("model = \"constant_gamma\"\ngamma_db = -14\nplants = true\n").plants);
}

// A permittivity of one's own is not bound by where the base was measured.
TEST_F(MaterialReader, NewPermittivityDropsTheBasesFrequencies) {
  EXPECT_EQ(read("base = \"wet_ground\"\n").highest_frequency_hz, 10e9);
  EXPECT_EQ(scatter::known_frequencies(read("base = \"wet_ground\"\nsoil = {moisture = 0.4}\n")).front().highest_hz,
            37e9);
  // What is left of a law that changes with frequency is known no further than before.
  EXPECT_EQ(read("base = \"wet_ground\"\nconductivity_s_per_m = 0.1\n").highest_frequency_hz, 10e9);
  EXPECT_EQ(read("base = \"concrete\"\npermittivity = 6\n").lowest_frequency_hz, 1e9);
  EXPECT_GT(read("base = \"concrete\"\npermittivity = 6\nconductivity_s_per_m = 0.1\n").highest_frequency_hz, 1e11);
  EXPECT_GT(read("base = \"metal\"\nconductivity_s_per_m = 1e6\n").highest_frequency_hz, 1e11);
}

// Nor is a γ of one's own, which is that of the frequency of use.
TEST_F(MaterialReader, NewGammaDropsTheBasesFrequencies) {
  const auto known = [&](const std::string& lines) { return scatter::known_frequencies(read(lines)); };
  EXPECT_EQ(known("base = \"grass\"\ngamma_db = -20\n"), known("model = \"constant_gamma\"\ngamma_db = -20\n"));
  // The base's own γ is known no further than before, whatever else is stated.
  EXPECT_EQ(known("base = \"grass\"\ncross_ratio_db = -8\n"), scatter::known_frequencies(read("base = \"grass\"\n")));
  EXPECT_EQ(read("base = \"grass\"\nfrequency_law = \"square_root_from_10_ghz\"\n").highest_frequency_hz, 40e9);
}

}  // namespace
}  // namespace sigmascape::scene
