#include "sigmascape/trace/viewpoint.h"

#include <gtest/gtest.h>

#include "sigmascape/base/units.h"
#include "sigmascape/radar/radar.h"

namespace sigmascape::trace {
namespace {

constexpr radar::Aspect south_east{130.0 * pi / 180.0, 20.0 * pi / 180.0};

TEST(DistantViewpoint, RangeIsThatOfAPlaneWave) {
  const auto from_north = Viewpoint::distant({0.0, radians_from_deg(30.0)});
  EXPECT_NEAR(from_north.range_of({0, 0, 0}), 0.0, 1e-12);
  EXPECT_NEAR(from_north.range_of({5, 100, 0}), -100.0 * std::cos(radians_from_deg(30.0)), 1e-9);
  EXPECT_NEAR(from_north.range_of({5, 0, 10}), -10.0 * 0.5, 1e-9);
}

TEST(DistantViewpoint, CrossGrowsToTheRightOfTheRadar) {
  // A radar in the north looks south and has the west on its right; one in the east has the north there.
  EXPECT_NEAR(Viewpoint::distant({0.0, 0.3}).cross_of({-7, 3, 20}), 7.0, 1e-12);
  EXPECT_NEAR(Viewpoint::distant({pi / 2.0, 0.3}).cross_of({-7, 3, 20}), 3.0, 1e-12);
}

TEST(DistantViewpoint, RangeAndCrossArePerpendicular) {
  const auto viewpoint = Viewpoint::distant(south_east);
  const Vec3d along = viewpoint.direction_from({});
  EXPECT_NEAR(viewpoint.cross_of(along * 123.0), 0.0, 1e-9);
  EXPECT_NEAR(viewpoint.range_of(along * 123.0), -123.0, 1e-9);
}

TEST(LocatedViewpoint, RangeAndAzimuthOfTheLineOfSight) {
  const auto viewpoint = Viewpoint::located({10, 20, 3000});
  EXPECT_NEAR(viewpoint.range_of({10, 4020, 0}), 5000.0, 1e-9);
  EXPECT_NEAR(viewpoint.cross_of({10, 4020, 0}), 0.0, 1e-12);
  EXPECT_NEAR(viewpoint.cross_of({110, 20, 50}), pi / 2.0, 1e-12);
  EXPECT_NEAR(length(viewpoint.direction_from({10, 4020, 0}) - Vec3d{0, -0.8, 0.6}), 0.0, 1e-12);
}

TEST(LocatedViewpoint, MiddleOfAzimuthsHoldsAcrossSouth) {
  const auto viewpoint = Viewpoint::located({0, 1000, 500});
  const double left = viewpoint.cross_of({10, 0, 0}), right = viewpoint.cross_of({-10, 0, 0});
  ASSERT_GT(left, 3.0);
  ASSERT_LT(right, -3.0);
  EXPECT_NEAR(std::remainder(viewpoint.middle_cross(left, right) - pi, 2.0 * pi), 0.0, 1e-12);
  EXPECT_NEAR(std::remainder(viewpoint.middle_cross(right, left) - pi, 2.0 * pi), 0.0, 1e-12);
  EXPECT_NEAR(viewpoint.middle_cross(0.1, 0.3), 0.2, 1e-12);
  EXPECT_EQ(Viewpoint::distant(south_east).middle_cross(-300.0, 100.0), -100.0);
}

TEST(LocatedViewpoint, TendsToTheDistantOne) {
  const double range_m = 1e8;
  const Vec3d position = radar::position_seeing({}, south_east.azimuth_rad, south_east.elevation_rad, range_m);
  const auto far = Viewpoint::located(position), distant = Viewpoint::distant(south_east);
  for (const Vec3d p : {Vec3d{0, 0, 0}, {300, -200, 0}, {-50, 400, 80}}) {
    EXPECT_NEAR(far.range_of(p) - range_m, distant.range_of(p), 2e-3);
    EXPECT_NEAR(
        std::remainder(far.cross_of(p) - far.cross_of({}), 2.0 * pi) * range_m * std::cos(south_east.elevation_rad),
        distant.cross_of(p), 2e-3);
    EXPECT_NEAR(length(far.direction_from(p) - distant.direction_from(p)), 0.0, 1e-5);
    EXPECT_NEAR(length(far.shadow_on_plane(p, -5.0) - distant.shadow_on_plane(p, -5.0)), 0.0, 1e-2);
    const double r = far.range_of(p);
    EXPECT_NEAR(far.ray_weight_m2(far.beam_of(p, 4.0), r, r) / distant.ray_weight_m2(distant.beam_of(p, 4.0), 0.0, 0.0),
                1.0, 1e-4);
    EXPECT_NEAR(far.landing_before_aim_m(p, p.z + 50.0), distant.landing_before_aim_m(p, p.z + 50.0), 0.05);
    EXPECT_NEAR(far.aim_behind_landing_m(p, p.z + 50.0), distant.aim_behind_landing_m(p, p.z + 50.0), 0.05);
  }
}

TEST(Viewpoint, WeightsCoverTheCrossSectionOfTheCell) {
  const auto distant = Viewpoint::distant(south_east);
  EXPECT_NEAR(distant.ray_weight_m2(distant.beam_of({1, 2, 3}, 4.0), 0.0, 0.0),
              4.0 * std::sin(south_east.elevation_rad), 1e-12);
  // 4 m² of level ground seen at 30° from 2000 m fill 2 m² / r²; the weight refers that to the echo's own range.
  const auto viewpoint = Viewpoint::located({0, 2000.0 * std::cos(pi / 6.0), 1000.0});
  const double beam = viewpoint.beam_of({}, 4.0);
  EXPECT_NEAR(viewpoint.ray_weight_m2(beam, 2000.0, 2000.0), 2.0, 1e-9);
  EXPECT_NEAR(viewpoint.ray_weight_m2(beam, 2100.0, 2050.0),
              2.0 / (2000.0 * 2000.0) * std::pow(2100.0, 4) / std::pow(2050.0, 2), 1e-9);
}

TEST(Viewpoint, ShadowLiesBehindAwayFromTheRadar) {
  const auto viewpoint = Viewpoint::distant({pi, radians_from_deg(30.0)});
  const Vec2d shadow = viewpoint.shadow_on_plane({3, 0, 10}, 0.0);
  EXPECT_NEAR(shadow.x, 3.0, 1e-9);
  EXPECT_NEAR(shadow.y, 10.0 / std::tan(radians_from_deg(30.0)), 1e-9);
}

TEST(Viewpoint, LandingIsShadowAndLayoverTogether) {
  const auto viewpoint = Viewpoint::distant(south_east);
  const double tan_elevation = std::tan(south_east.elevation_rad);
  EXPECT_NEAR(viewpoint.landing_before_aim_m({}, 30.0), 30.0 / tan_elevation + 30.0 * tan_elevation, 1e-9);
  EXPECT_NEAR(viewpoint.landing_before_aim_m({1, 2, 10}, 40.0), viewpoint.aim_behind_landing_m({4, 5, 10}, 40.0), 1e-9);
}

TEST(Viewpoint, LandingOfALocatedRadarFollowsItsCircle) {
  const Vec3d radar{0, -4000, 1500};
  const auto viewpoint = Viewpoint::located(radar);
  const Vec3d hit{0, 100, 200};
  const Vec2d aim = viewpoint.shadow_on_plane(hit, 20.0);
  // The place at the height of the aim point with the range of the hit.
  const double ground_m = std::sqrt(std::pow(viewpoint.range_of(hit), 2) - std::pow(1480.0, 2));
  const Vec3d landing{0, -4000 + ground_m, 20};
  EXPECT_NEAR(viewpoint.range_of(landing), viewpoint.range_of(hit), 1e-9);
  EXPECT_NEAR(viewpoint.landing_before_aim_m({aim.x, aim.y, 20.0}, 200.0), aim.y - landing.y, 1e-6);
  EXPECT_NEAR(viewpoint.aim_behind_landing_m(landing, 200.0), aim.y - landing.y, 1e-6);
  EXPECT_NEAR(viewpoint.point_behind_landing_m(landing, 200.0), hit.y - landing.y, 1e-6);
  EXPECT_NEAR(viewpoint.landing_before_m(hit, 20.0), hit.y - landing.y, 1e-6);
}

TEST(Viewpoint, PointsLieOverByTheTangentOfTheElevation) {
  const auto viewpoint = Viewpoint::distant(south_east);
  EXPECT_NEAR(viewpoint.point_behind_landing_m({1, 2, 10}, 40.0), 30.0 * std::tan(south_east.elevation_rad), 1e-9);
  EXPECT_NEAR(viewpoint.landing_before_m({1, 2, 40}, 10.0), 30.0 * std::tan(south_east.elevation_rad), 1e-9);
}

}  // namespace
}  // namespace sigmascape::trace
