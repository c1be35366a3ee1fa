#include "sigmascape/live/sector.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

#include "sigmascape/base/units.h"
#include "sigmascape/base/vec.h"

namespace sigmascape::live {
namespace {

bool holds(double first_azimuth_rad, double width_rad, double near_m, double far_m, Vec2d p) {
  const double distance = length(p);
  const double azimuth = wrapped_azimuth(azimuth_of(p) - first_azimuth_rad);
  return distance >= near_m && distance <= far_m && azimuth <= width_rad;
}

class SectorTest : public testing::TestWithParam<double> {};

TEST_P(SectorTest, RowsHoldJustThePointsOfTheSector) {
  const double first = radians_from_deg(GetParam()), width = radians_from_deg(70.0);
  const Sector sector(first, width, 300.0, 1000.0);
  const radar::Rectangle box = sector.bounds();
  for (double y = -1100.5; y < 1100.0; y += 13.0) {
    const auto stretches = sector.along_row(y);
    for (double x = -1100.5; x < 1100.0; x += 7.0) {
      bool inside = false;
      for (std::size_t s = 0; s < stretches.count; ++s) {
        inside = inside || (x >= stretches.of[s].west_m && x <= stretches.of[s].east_m);
      }
      ASSERT_EQ(inside, holds(first, width, 300.0, 1000.0, {x, y})) << x << " " << y;
      if (inside) {
        ASSERT_TRUE(box.contains({x, y})) << x << " " << y;
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(AllRound, SectorTest,
                         testing::Values(-35.0, 10.0, 55.0, 100.0, 145.0, 190.0, 235.0, 280.0, 325.0));

TEST(Sector, BoundsAreTight) {
  const Sector north(radians_from_deg(-30.0), radians_from_deg(60.0), 100.0, 1000.0);
  const radar::Rectangle box = north.bounds();
  EXPECT_NEAR(box.north_m, 1000.0, 1e-9);
  EXPECT_NEAR(box.west_m, -500.0, 1e-9);
  EXPECT_NEAR(box.east_m, 500.0, 1e-9);
  EXPECT_NEAR(box.south_m, 100.0 * std::cos(radians_from_deg(30.0)), 1e-9);
}

/// How far a place is from a sector about north.
double distance_to(double half_width_rad, double near_m, double far_m, Vec2d p) {
  double least = 1e300;
  for (int a = -200; a <= 200; ++a) {
    const double azimuth = half_width_rad * a / 200.0;
    const Vec2d along{std::sin(azimuth), std::cos(azimuth)};
    const double distance = std::clamp(p.x * along.x + p.y * along.y, near_m, far_m);
    least = std::min(least, length(p - along * distance));
  }
  return least;
}

TEST(Sector, AMarginReachesToAllSides) {
  constexpr double margin_m = 3.0;
  for (const double width_rad : {0.01, 0.7, 1.5}) {
    for (const double near_m : {0.0, 20.0}) {
      const Sector sector(-0.5 * width_rad, width_rad, near_m, 60.0, margin_m);
      const radar::Rectangle box = sector.bounds();
      for (double y = -10.25; y < 70.0; y += 0.5) {
        const auto stretches = sector.along_row(y);
        for (double x = -70.25; x < 70.0; x += 0.5) {
          bool inside = false;
          for (std::size_t s = 0; s < stretches.count; ++s)
            inside = inside || (x >= stretches.of[s].west_m && x <= stretches.of[s].east_m);
          const double distance_m = distance_to(0.5 * width_rad, near_m, 60.0, {x, y});
          if (distance_m < margin_m - 0.1) {
            ASSERT_TRUE(inside) << x << " " << y << ", " << width_rad;
          }
          // At corners it is no rounder than a square.
          if (distance_m > 2.0 * margin_m) {
            ASSERT_FALSE(inside) << x << " " << y << ", " << width_rad;
          }
          if (inside) {
            ASSERT_TRUE(box.contains({x, y})) << x << " " << y;
          }
        }
      }
    }
  }
}

}  // namespace
}  // namespace sigmascape::live
