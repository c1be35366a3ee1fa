#include "sigmascape/radar/sea_horizon.h"

#include <cmath>
#include <gtest/gtest.h>
#include <limits>

#include "sigmascape/radar/curved_earth.h"

namespace sigmascape::radar {
namespace {

constexpr CurvedEarth earth;
constexpr double nothing = -std::numeric_limits<double>::infinity();

/// How high the line of sight under a slope runs above the sea.
double above_sea_m(double radar_height_m, double slope, double distance_m) {
  return radar_height_m + slope * distance_m + earth.drop_m(distance_m);
}

TEST(SeaHorizon, IsWhereTheLineOfSightTouchesTheSea) {
  for (const double height_m : {2.0, 100.0, 9000.0}) {
    const SeaHorizon sea(height_m, 0.0, earth.curvature_per_m());
    const double horizon_m = sea.distance_m(), slope = sea.slope_before(2.0 * horizon_m);
    EXPECT_NEAR(horizon_m, earth.horizon_m(height_m), 1e-6);
    EXPECT_NEAR(above_sea_m(height_m, slope, horizon_m), 0.0, 1e-6 * height_m);
    EXPECT_GT(above_sea_m(height_m, slope, 0.9 * horizon_m), 0.0);
    EXPECT_GT(above_sea_m(height_m, slope, 1.1 * horizon_m), 0.0);
  }
}

TEST(SeaHorizon, HidesNothingBeforeIt) {
  const SeaHorizon sea(100.0, 0.0, earth.curvature_per_m());
  EXPECT_EQ(sea.slope_before(earth.horizon_m(100.0) - 1.0), nothing);
}

TEST(SeaHorizon, IsThatOfLowerGroundWhereThereIsSuchAndOfTheSeaUnderHigherGround) {
  const double lower_m = SeaHorizon(100.0, -400.0, earth.curvature_per_m()).distance_m();
  EXPECT_NEAR(lower_m, earth.horizon_m(500.0), 1e-6);
  const double higher_m = SeaHorizon(100.0, 400.0, earth.curvature_per_m()).distance_m();
  EXPECT_NEAR(higher_m, earth.horizon_m(100.0), 1e-6);
}

TEST(SeaHorizon, IsNowhereOverAFlatEarthAndFromBelowTheSea) {
  EXPECT_EQ(SeaHorizon(100.0, 0.0, CurvedEarth::flat().curvature_per_m()).slope_before(1e9), nothing);
  EXPECT_EQ(SeaHorizon(-10.0, 0.0, earth.curvature_per_m()).slope_before(1e9), nothing);
}

}  // namespace
}  // namespace sigmascape::radar
