#include "sigmascape/receiver/ground_accumulator.h"

#include <cmath>
#include <gtest/gtest.h>

#include "sigmascape/base/units.h"

namespace sigmascape::receiver {
namespace {

constexpr radar::GroundGrid grid{.west_m = -50.0, .north_m = 50.0, .cell_m = 0.5, .columns = 200, .rows = 200};

/// What a distant radar receives from a point: its range along the line of sight and its place to the right of it.
radar::Echo echo_of(Vec3d point, const radar::Aspect& aspect, float power = 1.0F) {
  const Vec3d to_radar = radar::direction_to_radar(aspect);
  const Vec3d right = cross(Vec3d{-to_radar.x, -to_radar.y, 0.0}, Vec3d{0, 0, 1});
  return {.range_m = -dot(point, to_radar), .cross = dot(point, normalized(right)), .rcs_m2 = {power, power, 0, power}};
}

/// Centre of the brightest cell.
Vec2d place_of(const GroundAccumulator& accumulator) {
  const auto sums = accumulator.bins().sums();
  for (std::size_t row = 0; row < grid.rows; ++row) {
    for (std::size_t column = 0; column < grid.columns; ++column) {
      if (sums(column, row).vv > 0.0F) return grid.centre_of(column, row);
    }
  }
  ADD_FAILURE() << "nothing arrived";
  return {};
}

TEST(GroundAccumulator, GroundPointsComeBackWhereTheyAre) {
  for (const double azimuth_deg : {0.0, 45.0, 130.0, 270.0}) {
    for (const double elevation_deg : {5.0, 37.0, 80.0}) {
      const radar::Aspect aspect{radians_from_deg(azimuth_deg), radians_from_deg(elevation_deg)};
      GroundAccumulator accumulator(grid, aspect);
      const radar::Echo echo = echo_of({12.25, -30.75, 0.0}, aspect);
      accumulator.add({&echo, 1});
      EXPECT_NEAR(length(place_of(accumulator) - Vec2d{12.25, -30.75}), 0.0, 1e-9)
          << azimuth_deg << " " << elevation_deg;
    }
  }
}

TEST(GroundAccumulator, HeightLiesOverTowardsTheRadar) {
  for (const double azimuth_deg : {0.0, 45.0, 130.0, 180.0, 270.0, 310.0}) {
    for (const double elevation_deg : {5.0, 21.0, 45.0}) {
      const radar::Aspect aspect{radians_from_deg(azimuth_deg), radians_from_deg(elevation_deg)};
      GroundAccumulator accumulator(grid, aspect);
      const radar::Echo echo = echo_of({5.0, 3.0, 30.0}, aspect);
      accumulator.add({&echo, 1});
      const Vec2d expected =
          Vec2d{5.0, 3.0} + radar::horizontal_direction(aspect.azimuth_rad) * (30.0 * std::tan(aspect.elevation_rad));
      const Vec2d off = place_of(accumulator) - expected;
      EXPECT_LE(std::max(std::abs(off.x), std::abs(off.y)), 0.25 + 1e-9) << azimuth_deg << "° " << elevation_deg << "°";
    }
  }
}

TEST(GroundAccumulator, SigmaIsCrossSectionOverCellArea) {
  const radar::Aspect aspect{1.0, 0.3};
  GroundAccumulator accumulator(grid, aspect);
  const std::vector<radar::Echo> echoes{echo_of({0.25, 0.25, 0.0}, aspect, 3.0F),
                                        echo_of({0.2, 0.3, 0.0}, aspect, 2.0F)};
  accumulator.add(echoes);
  EXPECT_FLOAT_EQ(accumulator.sigma0()(100, 99).vv, 20.0F);
  EXPECT_DOUBLE_EQ(accumulator.bins().total()[0], 5.0);
}

TEST(GroundAccumulator, WhatLandsOutsideIsLeftOut) {
  const radar::Aspect aspect{0.0, 0.3};
  GroundAccumulator accumulator(grid, aspect);
  for (const Vec3d point : {Vec3d{0, 50.01, 0}, {0, -50.01, 0}, {-50.01, 0, 0}, {50.01, 0, 0}, {0, 0, 1e6}}) {
    const radar::Echo echo = echo_of(point, aspect);
    accumulator.add({&echo, 1});
  }
  EXPECT_EQ(accumulator.bins().total()[0], 0.0);
}

}  // namespace
}  // namespace sigmascape::receiver
