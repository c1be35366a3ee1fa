#include "sigmascape/radar/look.h"

#include <gtest/gtest.h>

#include "sigmascape/base/units.h"

namespace sigmascape::radar {
namespace {

TEST(HorizontalDirection, TurnsClockwiseFromNorth) {
  const auto expect = [](double azimuth_deg, Vec2d direction) {
    EXPECT_NEAR(length(horizontal_direction(radians_from_deg(azimuth_deg)) - direction), 0.0, 1e-12) << azimuth_deg;
  };
  expect(0.0, {0, 1});
  expect(90.0, {1, 0});
  expect(180.0, {0, -1});
  expect(270.0, {-1, 0});
  expect(-90.0, {-1, 0});
}

TEST(DirectionToRadar, IsAUnitVectorAboveTheHorizontal) {
  for (const double azimuth_deg : {0.0, 77.0, 200.0}) {
    for (const double elevation_deg : {0.0, 5.0, 60.0, 90.0}) {
      const Vec3d to_radar = direction_to_radar({radians_from_deg(azimuth_deg), radians_from_deg(elevation_deg)});
      EXPECT_NEAR(length(to_radar), 1.0, 1e-12);
      EXPECT_NEAR(deg_from_radians(std::asin(to_radar.z)), elevation_deg, 1e-6);
    }
  }
}

TEST(DirectionToRadar, SouthEastIsEastAndSouth) {
  const Vec3d to_radar = direction_to_radar({radians_from_deg(130.0), radians_from_deg(13.0)});
  EXPECT_NEAR(to_radar.x, std::sin(radians_from_deg(50.0)) * std::cos(radians_from_deg(13.0)), 1e-12);
  EXPECT_NEAR(to_radar.y, -std::cos(radians_from_deg(50.0)) * std::cos(radians_from_deg(13.0)), 1e-12);
}

TEST(LookSide, IsThatOfTheCourseOnTheMap) {
  const Vec3d eastwards{100.0, 0.0, 5.0};
  EXPECT_STREQ(look_side(eastwards, {50.0, 10.0, -900.0}), "left");
  EXPECT_STREQ(look_side(eastwards, {-50.0, -10.0, -900.0}), "right");
  EXPECT_STREQ(look_side(eastwards, {50.0, 0.0, -900.0}), "neither");
  EXPECT_STREQ(look_side({}, {50.0, 10.0, 0.0}), "neither");
}

}  // namespace
}  // namespace sigmascape::radar
