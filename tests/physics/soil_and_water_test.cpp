#include <complex>
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "physics/normal_reflectivity.h"
#include "validation/validation_record.h"

#include "sigmascape/base/units.h"
#include "sigmascape/scatter/permittivity.h"

namespace sigmascape::physics_test {
namespace {

using scatter::Permittivity;
using scatter::SoilPermittivity;
using scatter::VegetationPermittivity;
using scatter::WaterPermittivity;
using Complex = std::complex<double>;

/// Published numbers carry `digits` of half a unit in their last place.
void expect_permittivity(const std::string& name, const Permittivity& permittivity, double f_ghz, Complex expected,
                         double half_digit, const char* source) {
  const Complex measured = permittivity.relative_at(f_ghz * 1e9);
  const auto report = [&](const char* part, double wanted, double found) {
    validation::expect_close({.group = "Permittivity",
                              .name = fmt::format("{}, {} GHz, {}", name, f_ghz, part),
                              .expected = wanted,
                              .measured = found,
                              .tolerance = half_digit * 1.02,
                              .unit = "1",
                              .source = source});
  };
  report("ε'", expected.real(), measured.real());
  report("ε''", -expected.imag(), -measured.imag());
}

TEST(Water, PureAtTwentyDegrees) {
  const char* source = "ITU-R P.527-4 evaluated independently";
  const WaterPermittivity water{20.0, 0.0};
  expect_permittivity("pure water, 20 °C", water, 1.3, {79.64, -5.70}, 0.005, source);
  expect_permittivity("pure water, 20 °C", water, 5.405, {73.18, -21.64}, 0.005, source);
  expect_permittivity("pure water, 20 °C", water, 10.0, {60.79, -32.72}, 0.005, source);
  expect_permittivity("pure water, 20 °C", water, 35.0, {19.56, -29.41}, 0.005, source);
}

TEST(Water, SeaAtTwentyDegrees) {
  const char* source = "ITU-R P.527-4 evaluated independently";
  const WaterPermittivity sea{20.0, 35.0};
  expect_permittivity("sea water, 20 °C, 35 g/kg", sea, 1.3, {71.33, -71.12}, 0.005, source);
  expect_permittivity("sea water, 20 °C, 35 g/kg", sea, 5.405, {66.19, -34.29}, 0.005, source);
  expect_permittivity("sea water, 20 °C, 35 g/kg", sea, 10.0, {56.03, -36.93}, 0.005, source);
  validation::expect_close({.group = "Permittivity",
                            .name = "sea water, 20 °C, 35 g/kg, conductivity",
                            .expected = 4.791,
                            .measured = sea.ionic_conductivity_s_per_m(),
                            .tolerance = 5e-4,
                            .unit = "S/m",
                            .source = source});
  const std::pair<double, double> reflectivities[] = {{1.3, 0.69}, {5.405, 0.64}, {10.0, 0.63}};
  for (const auto& [f_ghz, expected] : reflectivities) {
    validation::expect_close({.group = "Permittivity",
                              .name = fmt::format("sea water, 20 °C, |R(0)|² at {} GHz", f_ghz),
                              .expected = expected,
                              .measured = normal_reflectivity(Permittivity(sea).relative_at(f_ghz * 1e9)),
                              .tolerance = 0.005,
                              .unit = "1",
                              .source = source});
  }
}

// Terms of these fits vanish, or nearly so, at 35 g/kg or without salt.
TEST(Water, BrackishAndCold) {
  const char* source = "ITU-R P.527-4 evaluated independently";
  const WaterPermittivity brackish{20.0, 10.0}, icy_sea{0.0, 35.0};
  expect_permittivity("brackish water, 20 °C, 10 g/kg", brackish, 1.3, {77.08, -26.66}, 0.005, source);
  expect_permittivity("brackish water, 20 °C, 10 g/kg", brackish, 10.0, {59.29, -34.21}, 0.005, source);
  expect_permittivity("sea water, 0 °C, 35 g/kg", icy_sea, 1.3, {76.67, -49.83}, 0.005, source);
  expect_permittivity("sea water, 0 °C, 35 g/kg", icy_sea, 10.0, {40.44, -41.55}, 0.005, source);
  expect_permittivity("pure water, 0 °C", WaterPermittivity{0.0, 0.0}, 10.0, {41.93, -40.75}, 0.005, source);
}

TEST(Water, ConductsByTheScaleOfPracticalSalinity) {
  struct Row {
    double temperature_c, salinity_g_per_kg, expected;
  };
  for (const Row& row : {Row{20.0, 10.0, 1.5336}, Row{10.0, 20.0, 2.2938}, Row{0.0, 35.0, 2.9036}}) {
    validation::expect_close(
        {.group = "Permittivity",
         .name = fmt::format("water, {} °C, {} g/kg, conductivity", row.temperature_c, row.salinity_g_per_kg),
         .expected = row.expected,
         .measured = WaterPermittivity{row.temperature_c, row.salinity_g_per_kg}.ionic_conductivity_s_per_m(),
         .tolerance = 1e-4,
         .unit = "S/m",
         .source = "Practical Salinity Scale 1978, solved for conductivity, 4.2914 S/m at 15 °C and 35"});
  }
}

TEST(Water, WithoutSaltDoesNotConduct) {
  EXPECT_EQ((WaterPermittivity{10.0, 0.0}.ionic_conductivity_s_per_m()), 0.0);
}

TEST(Soil, LoamByMoisture) {
  const char* source = "ITU-R P.527-4, 40 % sand and 20 % clay at 23 °C, evaluated independently";
  const auto loam = [](double moisture) { return SoilPermittivity{40.0, 20.0, moisture}; };
  expect_permittivity("loam, moisture 0.1", loam(0.1), 5.405, {6.62, -0.72}, 0.005, source);
  expect_permittivity("loam, moisture 0.2", loam(0.2), 5.405, {11.49, -1.84}, 0.005, source);
  expect_permittivity("loam, moisture 0.3", loam(0.3), 5.405, {17.35, -3.31}, 0.005, source);
  expect_permittivity("loam, moisture 0.1", loam(0.1), 10.0, {6.22, -0.86}, 0.005, source);
  expect_permittivity("loam, moisture 0.2", loam(0.2), 10.0, {10.44, -2.45}, 0.005, source);
  expect_permittivity("loam, moisture 0.3", loam(0.3), 10.0, {15.49, -4.61}, 0.005, source);
}

// Clay conducts, which is most of the loss at metre waves.
TEST(Soil, ClayAtLowFrequencies) {
  const char* source =
      "Peplinski et al. 1995, conductivity for 0.3 to 1.3 GHz, 5 % sand and 47.4 % clay at 23 °C, evaluated "
      "independently";
  const SoilPermittivity silty_clay{5.0, 47.4, 0.2};
  expect_permittivity("silty clay, moisture 0.2", silty_clay, 0.3, {7.04, -4.63}, 0.005, source);
  expect_permittivity("silty clay, moisture 0.2", silty_clay, 1.3, {8.19, -2.06}, 0.005, source);
}

TEST(Vegetation, LeavesByMoisture) {
  const char* source = "Ulaby and El-Rayes, Code 4.8, evaluated independently";
  const VegetationPermittivity fresh{0.6};
  expect_permittivity("leaves, moisture 0.6", fresh, 1.3, {22.9, -9.6}, 0.05, source);
  expect_permittivity("leaves, moisture 0.6", fresh, 5.4, {19.1, -6.8}, 0.05, source);
  expect_permittivity("leaves, moisture 0.6", fresh, 10.0, {16.6, -7.4}, 0.05, source);
  const std::pair<double, double> reflectivities[] = {{0.6, 0.394}, {0.3, 0.185}};
  for (const auto& [moisture, expected] : reflectivities) {
    validation::expect_close(
        {.group = "Permittivity",
         .name = fmt::format("leaves, moisture {}, |R(0)|² at 10 GHz", moisture),
         .expected = expected,
         .measured = normal_reflectivity(Permittivity(VegetationPermittivity{moisture}).relative_at(10e9)),
         .tolerance = 5e-4,
         .unit = "1",
         .source = source});
  }
}

// Of dry clay the fit of conductivity would leave water with less than nothing.
TEST(Soil, HasAPermittivityWhereverItMayBeAskedFor) {
  for (const double sand : {5.0, 40.0, 90.0}) {
    for (const double clay : {5.0, 20.0, 47.4, 90.0}) {
      if (sand + clay >= 100.0) continue;
      for (const double moisture : {0.01, 0.03, 0.05, 0.1, 0.5}) {
        for (double f = 0.3e9; f <= 40e9; f *= 1.2) {
          const Complex permittivity = SoilPermittivity{sand, clay, moisture}.relative_at(f);
          ASSERT_GE(permittivity.real(), 1.0) << sand << " " << clay << " " << moisture << " " << f;
          ASSERT_LE(permittivity.imag(), 0.0) << sand << " " << clay << " " << moisture << " " << f;
        }
      }
    }
  }
}

// Passive materials lose energy and never beat vacuum, wherever the laws are used.
TEST(Permittivity, EveryLawIsPassive) {
  const Permittivity laws[] = {WaterPermittivity{0.0, 0.0},       WaterPermittivity{30.0, 38.0},
                               SoilPermittivity{90.0, 5.0, 0.03}, SoilPermittivity{20.0, 60.0, 0.4},
                               VegetationPermittivity{0.05},      VegetationPermittivity{0.7}};
  for (const Permittivity& law : laws) {
    const auto [lowest_hz, highest_hz] = law.valid_frequencies();
    for (double f = std::max(lowest_hz, 0.3e9); f <= std::min(highest_hz, 300e9); f *= 1.3) {
      EXPECT_GE(law.relative_at(f).real(), 1.0) << f;
      EXPECT_LE(law.relative_at(f).imag(), 0.0) << f;
    }
  }
}

}  // namespace
}  // namespace sigmascape::physics_test
