#include "sigmascape/render/skyline.h"

#include <cmath>
#include <gtest/gtest.h>

#include "made_landscape.h"

#include "sigmascape/base/units.h"
#include "sigmascape/radar/radar.h"

namespace sigmascape::render {
namespace {

constexpr radar::Rectangle area{-60.0, -60.0, 60.0, 60.0};
/// In single precision, and between the middles of steps.
constexpr double close = 1e-4;

// Behind a bar that is 20 m wide its far edge is the steepest of it; before it the ground is.
TEST(Skyline, IsTheTopOfWhatStandsBefore) {
  const auto terrain = level_ground();
  const auto bar = obstacles(solid_bar(-20.0, 0.0, 15.0F));
  const Vec3d radar{30.0, -300.0, 100.0};
  const Skyline skyline(bar, terrain, radar::Vantage(radar), area);
  for (const double x : {-50.0, 0.0, 47.0}) {
    const Vec2d behind{x, 40.0}, before{x, -40.0};
    const double towards = (behind.y - radar.y) / length(behind - Vec2d{radar.x, radar.y});
    const double slope_of_edge = (15.0 - radar.z) * towards / (0.0 - radar.y);
    EXPECT_NEAR(skyline.before(behind).solid, slope_of_edge, 0.01 * std::abs(slope_of_edge));
    const double distance_m = length(before - Vec2d{radar.x, radar.y});
    EXPECT_LE(skyline.before(before).solid, -radar.z / distance_m + close);
    EXPECT_GT(skyline.before(before).solid, -radar.z / (distance_m - 2.0 * square_m));
  }
}

// A line of sight may pass over what is solid and through crowns.
TEST(Skyline, KnowsCrownsByThemselves) {
  const auto terrain = level_ground();
  const auto mixed = obstacles([](Vec2d place) {
    if (place.y > -40.0 && place.y < -30.0) return radar::Obstacle{.solid_top_m = 4.0F};
    if (place.y > -20.0 && place.y < -10.0)
      return radar::Obstacle{.crown_base_m = 2.0F, .crown_top_m = 12.0F, .crown_extinction_per_m = 0.1F};
    return radar::Obstacle{};
  });
  const Vec3d radar{0.0, -1000.0, 20.0};
  const Skyline skyline(mixed, terrain, radar::Vantage(radar), area);
  EXPECT_EQ(skyline.before({0.0, -25.0}).crowns, -std::numeric_limits<float>::infinity());
  EXPECT_NEAR(skyline.before({0.0, 20.0}).crowns, (12.0 - 20.0) / 990.0, close);
  EXPECT_NEAR(skyline.before({0.0, 20.0}).solid, (4.0 - 20.0) / 970.0, close);
}

// Each place is looked at from where the platform is abeam of it: what a block stands before lies straight behind it.
TEST(Skyline, OfAStripRunsAlongItsBeam) {
  const auto terrain = level_ground();
  const auto block = obstacles([](Vec2d place) {
    const bool within = place.x > 40.0 && place.x < 50.0 && place.y > -20.0 && place.y < -10.0;
    return radar::Obstacle{.solid_top_m = within ? 10.0F : 0.0F};
  });
  const radar::PassingBeam beam{
      .position = {-400.0, -300.0, 100.0}, .velocity_mps = {50.0, 0.0, 0.0}, .outwards = {0.0, 1.0}};
  const Skyline skyline(block, terrain, radar::Vantage(beam), area);
  const double slope_of_block = (10.0 - 100.0) / 290.0;
  EXPECT_NEAR(skyline.before({45.0, 30.0}).solid, slope_of_block, 0.01);
  // Where it is hidden from where the platform is at time zero.
  EXPECT_LT(skyline.before({58.0, -2.0}).solid, slope_of_block);
  EXPECT_NEAR(skyline.before({58.0, -2.0}).solid, -100.0 / 297.0, 0.005);
}

// Beyond the bulge of the Earth a slope counts from the plane at the radar's foot.
TEST(Skyline, FallsAwayWithTheEarth) {
  const radar::CurvedEarth earth;
  const Vec3d radar{0.0, -100e3, 2000.0};
  EXPECT_NEAR(Skyline::slope_to({}, radar, earth), -(2000.0 + earth.drop_m(100e3)) / 100e3, 1e-12);
  const auto terrain = level_ground();
  const auto bare = obstacles([](Vec2d) { return radar::Obstacle{}; });
  const Skyline skyline(bare, terrain, radar::Vantage(radar), area, earth);
  EXPECT_NEAR(skyline.before({}).solid, Skyline::slope_to({}, radar, earth), 1e-6);
}

// Of the 100 km of sea before the area nothing is known but that the Earth is round.
TEST(Skyline, IsTheSeaBeyondItsHorizon) {
  const radar::CurvedEarth earth;
  const Vec3d radar{0.0, -100e3, 100.0};
  const auto terrain = level_ground();
  const auto bare = obstacles([](Vec2d) { return radar::Obstacle{}; });
  const double horizon_m = earth.horizon_m(radar.z);
  const double to_horizon = Skyline::slope_to({0.0, radar.y + horizon_m, 0.0}, radar, earth);
  for (const double y : {-50.0, 50.0}) {
    EXPECT_NEAR(Skyline(bare, terrain, radar::Vantage(radar), area, earth).before({0.0, y}).solid, to_horizon, 1e-7);
  }
}

}  // namespace
}  // namespace sigmascape::render
