#include "sigmascape/receiver/polar_ground.h"

#include <cmath>
#include <gtest/gtest.h>

#include "sigmascape/base/hash.h"
#include "sigmascape/base/units.h"

namespace sigmascape::receiver {
namespace {

constexpr radar::GroundGrid two_metre_cells{.west_m = 30.0, .north_m = 80.0, .cell_m = 2.0, .columns = 32, .rows = 32};

radar::Echo echo_of(Vec3d point, const radar::Aspect& aspect, float rcs_m2) {
  const Vec3d to_radar = radar::direction_to_radar(aspect);
  const Vec2d towards = radar::horizontal_direction(aspect.azimuth_rad);
  return {.range_m = -dot(point, to_radar),
          .cross = point.x * -towards.y + point.y * towards.x,
          .rcs_m2 = {rcs_m2, 0.5F * rcs_m2, 0, 0}};
}

/// Centre of mass of what a point returns.
Vec2d place_of(Vec3d point, const radar::Aspect& aspect) {
  PolarGround ground(two_metre_cells, aspect);
  const radar::Echo echo = echo_of(point, aspect, 1.0F);
  ground.add({&echo, 1});
  const auto sigma0 = ground.sigma0();
  Vec2d sum{};
  double total = 0.0;
  for (std::size_t row = 0; row < two_metre_cells.rows; ++row) {
    for (std::size_t column = 0; column < two_metre_cells.columns; ++column) {
      const auto part = static_cast<double>(sigma0(column, row).vv);
      sum = sum + two_metre_cells.centre_of(column, row) * part;
      total += part;
    }
  }
  EXPECT_GT(total, 0.0);
  return sum * (1.0 / total);
}

TEST(PolarGround, PointsComeBackWithinABinOfWhereTheyAre) {
  for (const double azimuth_deg : {0.0, 30.0, 135.0, 250.0}) {
    for (const double elevation_deg : {5.0, 37.0}) {
      const radar::Aspect aspect{radians_from_deg(azimuth_deg), radians_from_deg(elevation_deg)};
      EXPECT_LT(length(place_of({40.0, 70.3, 0.0}, aspect) - Vec2d{40.0, 70.3}), 2.0) << azimuth_deg;
    }
  }
}

TEST(PolarGround, HeightLiesOverTowardsTheRadar) {
  const radar::Aspect aspect{radians_from_deg(130.0), radians_from_deg(37.0)};
  const Vec2d expected =
      Vec2d{61.0, 47.3} + radar::horizontal_direction(aspect.azimuth_rad) * (12.0 * std::tan(aspect.elevation_rad));
  EXPECT_LT(length(place_of({61.0, 47.3, 12.0}, aspect) - expected), 2.0);
}

TEST(PolarGround, EvenGroundIsEvenHoweverItIsTurned) {
  for (const double azimuth_deg : {0.0, 45.0, 72.0}) {
    const radar::Aspect aspect{radians_from_deg(azimuth_deg), radians_from_deg(13.0)};
    PolarGround ground(two_metre_cells, aspect);
    // 64 points of 0.02 · 4 m² / 64 on every 2 m square, and as far around that no bin at the edge is half full.
    for (int y = -20; y < 80; ++y) {
      for (int x = -20; x < 80; ++x) {
        for (std::uint64_t k = 0; k < 64; ++k) {
          const auto u = static_cast<double>(unit_float(hashed(x, y, k, 1)));
          const auto v = static_cast<double>(unit_float(hashed(x, y, k, 2)));
          const radar::Echo echo = echo_of({2.0 * (x + u), 2.0 * (y + v), 0.0}, aspect, 0.02F * 4.0F / 64.0F);
          ground.add({&echo, 1});
        }
      }
    }
    double sum = 0.0;
    const Array2D<radar::Channels> sigma0 = ground.sigma0();
    for (const radar::Channels& cell : sigma0.values()) {
      // The number of points that fall into a bin scatters by 1/√64, less after the interpolation.
      EXPECT_NEAR(cell.vv, 0.02, 0.02 * 0.6);
      EXPECT_FLOAT_EQ(cell.hh, 0.5F * cell.vv);
      sum += static_cast<double>(cell.vv);
    }
    EXPECT_NEAR(sum / (32.0 * 32.0), 0.02, 0.02 * 0.015) << azimuth_deg;
  }
}

}  // namespace
}  // namespace sigmascape::receiver
