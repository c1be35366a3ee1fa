#include "sigmascape/radar/radar.h"

#include <cmath>
#include <gtest/gtest.h>
#include <utility>

#include "sigmascape/base/units.h"

namespace sigmascape::radar {
namespace {

TEST(PositionSeeing, StandsAtTheAskedRangeAndAngles) {
  const Vec3d target{100.0, -200.0, 35.0};
  const Vec3d position = position_seeing(target, radians_from_deg(130.0), radians_from_deg(13.0), 20e3);
  const Vec3d away = position - target;
  EXPECT_NEAR(length(away), 20e3, 1e-6);
  EXPECT_NEAR(deg_from_radians(std::asin(away.z / length(away))), 13.0, 1e-9);
  EXPECT_NEAR(deg_from_radians(azimuth_of(away)), 130.0, 1e-9);
}

TEST(PositionSeeing, AzimuthIsWhereTheRadarStands) {
  const auto from = [](double azimuth_deg) { return position_seeing({}, radians_from_deg(azimuth_deg), 0.0, 1000.0); };
  EXPECT_NEAR(length(from(0.0) - Vec3d{0, 1000, 0}), 0.0, 1e-9);
  EXPECT_NEAR(length(from(90.0) - Vec3d{1000, 0, 0}), 0.0, 1e-9);
  EXPECT_NEAR(length(position_seeing({5, 6, 7}, 1.0, pi / 2.0, 1000.0) - Vec3d{5, 6, 1007}), 0.0, 1e-9);
}

TEST(PositionSeeing, OverARoundEarthKeepsItsRangeAndGrazingAngle) {
  const CurvedEarth earth;
  for (const auto& [elevation_deg, slant_range_m] : {std::pair(1.0, 100e3), {5.0, 60e3}, {40.0, 2e3}}) {
    const Vec3d target{100.0, -200.0, 35.0};
    const Vec3d position =
        position_seeing(target, radians_from_deg(130.0), radians_from_deg(elevation_deg), slant_range_m, earth);
    const Vec2d away{position.x - target.x, position.y - target.y};
    EXPECT_NEAR(deg_from_radians(azimuth_of(away)), 130.0, 1e-9);
    EXPECT_NEAR(earth.slant_range_m(position.z, target.z, length(away)), slant_range_m, 1e-6);
    EXPECT_NEAR(deg_from_radians(std::asin(earth.sin_grazing(position.z, target.z, length(away)))), elevation_deg,
                1e-7);
  }
}

}  // namespace
}  // namespace sigmascape::radar
