#include "sigmascape/radar/antenna_pattern.h"

#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

#include "sigmascape/base/units.h"

namespace sigmascape::radar {
namespace {

constexpr double width = 0.05;
const BeamShape shapes[] = {GaussianBeam{}, ApertureBeam{{.shape = WindowShape::Rectangular}},
                            ApertureBeam{{.shape = WindowShape::Cosine}}, ApertureBeam{}};

TEST(AntennaCut, HalfPowerWidthIsExact) {
  for (const BeamShape& shape : shapes) {
    const AntennaCut cut(shape, width);
    EXPECT_DOUBLE_EQ(cut.power(0.0), 1.0);
    EXPECT_NEAR(cut.power(0.5 * width), 0.5, 1e-9);
    EXPECT_NEAR(cut.power(-0.5 * width), 0.5, 1e-9);
    EXPECT_NEAR(cut.two_way_power(0.5 * width), 0.25, 1e-9);
  }
}

TEST(AntennaCut, TwoWayWidthIsWhereTwoWayPowerHalves) {
  for (const BeamShape& shape : shapes) {
    const AntennaCut cut(shape, width);
    EXPECT_NEAR(cut.two_way_power(0.5 * cut.two_way_width_rad()), 0.5, 1e-9);
    EXPECT_LT(cut.two_way_width_rad(), width);
  }
  EXPECT_DOUBLE_EQ(AntennaCut(GaussianBeam{}, width).two_way_width_rad(), width / std::numbers::sqrt2);
}

TEST(AntennaCut, SideLobesOfAnApertureChangeSign) {
  const AntennaCut cut(ApertureBeam{{.shape = WindowShape::Rectangular}}, width);
  EXPECT_LT(cut.voltage(1.6 * width), 0.0);
  EXPECT_GT(cut.voltage(2.8 * width), 0.0);
  EXPECT_EQ(cut.voltage(pi), 0.0);
}

TEST(AntennaCut, FloorHoldsEverywhere) {
  const AntennaCut cut(GaussianBeam{}, width, linear_from_db(-40.0));
  EXPECT_NEAR(db_from_linear(cut.power(1.0)), -40.0, 1e-9);
  EXPECT_NEAR(db_from_linear(cut.power(pi)), -40.0, 1e-9);
  EXPECT_DOUBLE_EQ(cut.power(0.0), 1.0);
}

// Level ground: sin δ = H/r, so csc² in power, twice, is r⁴.
TEST(AntennaCut, GaussianBeamsAreSilentFarOutUnlessTheyHaveAFloor) {
  const AntennaCut beam(GaussianBeam{}, 0.01);
  EXPECT_EQ(beam.two_way_power(beam.silent_beyond_rad()), 0.0);
  EXPECT_GT(beam.two_way_power(0.9 * beam.silent_beyond_rad()), 0.0);
  EXPECT_TRUE(std::isinf(AntennaCut(GaussianBeam{}, 0.01, 1e-6).silent_beyond_rad()));
  EXPECT_TRUE(std::isinf(AntennaCut(ApertureBeam{}, 0.01).silent_beyond_rad()));
}

TEST(AntennaCut, CosecantSquaredUndoesSpreadingOverLevelGround) {
  const double peak = radians_from_deg(-4.0);
  const AntennaCut cut(CosecantSquaredBeam{radians_from_deg(40.0)}, radians_from_deg(3.0), 0.0, peak);
  const auto returned = [&](double depression_deg) {
    const double depression = radians_from_deg(depression_deg);
    return cut.two_way_power(-depression - peak) * std::pow(std::sin(depression), 4.0);
  };
  EXPECT_NEAR(cut.power(0.0), 1.0, 1e-12);
  for (const double depression_deg : {5.0, 10.0, 20.0, 39.0})
    EXPECT_NEAR(returned(depression_deg) / returned(4.0), 1.0, 1e-9) << depression_deg;
  EXPECT_LT(returned(45.0) / returned(4.0), 1e-3);
  EXPECT_NEAR(cut.power(radians_from_deg(1.5)), 0.5, 1e-9);
}

TEST(AntennaCut, TableIsLinearInDecibels) {
  const AntennaCut cut(TabulatedBeam{{{-1.0, 0.01}, {0.0, 1.0}, {1.0, 0.01}}}, width);
  EXPECT_NEAR(cut.power(0.5 * width), 0.1, 1e-12);
  EXPECT_NEAR(cut.power(-0.25 * width), std::pow(10.0, -0.5), 1e-12);
  EXPECT_NEAR(cut.power(3.0 * width), 0.01, 1e-12);
}

TEST(AntennaPattern, PointsWhereItIsTilted) {
  const AntennaPattern pattern(
      {.elevation = GaussianBeam{}, .elevation_width_rad = 0.2, .tilt_rad = -0.3, .gain = 400.0}, width);
  EXPECT_NEAR(pattern.gain(0.0, -0.3), 400.0, 1e-9);
  EXPECT_NEAR(pattern.gain(0.0, -0.2), 200.0, 1e-9);
  EXPECT_NEAR(pattern.gain(0.5 * width, -0.4), 100.0, 1e-9);
  EXPECT_NEAR(pattern.voltage(0.0, -0.3), 20.0, 1e-9);
}

// ∬ of two narrow Gaussians is π θ φ / (4 ln 2); an isotropic antenna has the gain one.
TEST(Directivity, OfGaussianBeamIsItsClosedForm) {
  const Antenna pencil{.elevation = GaussianBeam{}, .elevation_width_rad = 0.03};
  EXPECT_NEAR(directivity(pencil, 0.02), 16.0 * std::numbers::ln2 / (0.02 * 0.03), 0.001 * 16.0 / 6e-4);
  EXPECT_NEAR(directivity({.azimuth = EvenBeam{}}, 0.02), 1.0, 1e-6);
}

}  // namespace
}  // namespace sigmascape::radar
