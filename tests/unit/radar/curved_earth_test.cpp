#include "sigmascape/radar/curved_earth.h"

#include <gtest/gtest.h>

#include "validation/validation_record.h"

namespace sigmascape::radar {
namespace {

constexpr CurvedEarth standard;

TEST(CurvedEarth, TheSeaDropsAwayAndEndsAtAHorizon) {
  validation::expect_close({.group = "Curved Earth",
                            .name = "drop of the sea at 100 km, 4/3 Earth",
                            .expected = 588.6,
                            .measured = standard.drop_m(100e3),
                            .tolerance = 0.1,
                            .unit = "m",
                            .source = "d² / 2kR, R = 6371 km"});
  validation::expect_close({.group = "Curved Earth",
                            .name = "horizon from 1 km, 4/3 Earth",
                            .expected = 130.3,
                            .measured = standard.horizon_m(1000.0) / 1000.0,
                            .tolerance = 0.05,
                            .unit = "km",
                            .source = "√(2kRh)"});
}

TEST(CurvedEarth, AFlatEarthIsPythagoras) {
  const auto flat = CurvedEarth::flat();
  EXPECT_DOUBLE_EQ(flat.slant_range_m(4000.0, 1000.0, 4000.0), 5000.0);
  EXPECT_DOUBLE_EQ(flat.sin_grazing(4000.0, 1000.0, 4000.0), 0.6);
  EXPECT_EQ(flat.drop_m(1e5), 0.0);
}

/// The same two from points in space, in extended precision.
TEST(CurvedEarth, RangeAndGrazingAngleAreThoseOfTheTriangleWithTheEarthsCentre) {
  for (const double distance : {10.0, 3e3, 40e3, 200e3, 400e3}) {
    for (const double height : {-50.0, 0.0, 3000.0}) {
      const long double radius = 4.0L / 3.0L * 6371008.8L, angle = static_cast<long double>(distance) / radius;
      const long double across = (radius + static_cast<long double>(height)) * std::sin(angle);
      const long double up = (radius + static_cast<long double>(height)) * std::cos(angle) - (radius + 9000.0L);
      const long double range = std::hypot(across, up);
      EXPECT_NEAR(standard.slant_range_m(9000.0, height, distance), static_cast<double>(range), 1e-6);
      const long double sine = (-across * std::sin(angle) - up * std::cos(angle)) / range;
      EXPECT_NEAR(standard.sin_grazing(9000.0, height, distance), static_cast<double>(sine), 1e-9);
    }
  }
}

TEST(CurvedEarth, TurnsVelocitiesAsPlacesMoveInTheStraightSpace) {
  constexpr Vec2d foot{300.0, -700.0};
  constexpr double step_s = 0.01;
  for (const Vec3d place : {Vec3d{100e3, 20e3, 3000.0}, Vec3d{300.0, 40e3, 10.0}, Vec3d{-9e3, -700.0, 9000.0}}) {
    for (const Vec3d velocity : {Vec3d{250.0, 0.0, 0.0}, Vec3d{-80.0, 170.0, -12.0}, Vec3d{0.0, 0.0, 30.0}}) {
      const Vec3d moved =
          standard.bent(place + velocity * step_s, foot) - standard.bent(place - velocity * step_s, foot);
      EXPECT_LT(length(standard.turned(velocity, place, foot) - moved * (0.5 / step_s)), 1e-6);
    }
  }
  const Vec3d anything{3.0, 4.0, 5.0};
  EXPECT_EQ(CurvedEarth::flat().turned(anything, {1e5, 0.0, 0.0}, foot), anything);
  EXPECT_LT(length(standard.turned(anything, {foot.x, foot.y, 0.0}, foot) - anything), 1e-12);
}

TEST(CurvedEarth, AtTheHorizonTheGrazingAngleIsZero) {
  const double horizon = standard.horizon_m(1000.0);
  EXPECT_GT(standard.sin_grazing(1000.0, 0.0, horizon - 100.0), 0.0);
  EXPECT_LT(standard.sin_grazing(1000.0, 0.0, horizon + 100.0), 0.0);
}

}  // namespace
}  // namespace sigmascape::radar
