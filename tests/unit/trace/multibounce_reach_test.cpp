#include "sigmascape/trace/multibounce_reach.h"

#include <cmath>
#include <gtest/gtest.h>
#include <vector>

#include "plain_scene.h"

#include "sigmascape/radar/radar.h"
#include "sigmascape/trace/path_tracer.h"

namespace sigmascape::trace {
namespace {

const radar::Aspect southern{pi, radians_from_deg(30.0)}, steep_southern{pi, radians_from_deg(60.0)};

/// A high wall that faces the radar over a low one 50 m before it, on black ground: what goes to and fro between the
/// two lands some 50 m, 100 m … behind the high one.
scene::Scene wall_behind_wall() {
  scene::Scene scene = plain_scene(0.0);
  add_box(scene, {30, 2, 50}, {0, 1}, 0.9);
  add_box(scene, {30, 2, 18}, {0, -51}, 0.9);
  return scene;
}

constexpr radar::Rectangle behind_wall{-40, 52, 40, 72};

/// The power of several bounces that lands behind the high wall when rays are launched for `launched`.
double landed(const scene::Scene& scene, const radar::Rectangle& launched, const MultibounceReach& reach,
              const radar::Aspect& aspect = southern) {
  const auto viewpoint = Viewpoint::distant(aspect);
  const SceneGeometry geometry(scene, Footing::LevelPlane);
  const PathTracer tracer(geometry, surface_models(scene, 10e9), viewpoint, {.max_bounces = 4, .roulette = false}, 3);
  LaunchArea launch = launch_area(viewpoint, launched, 1.0, 0.0, geometry.highest_m() + 1.0, reach);
  spare_rays(launch, scene, geometry.footing());
  double sum = 0.0;
  tracer.trace(launch, {0, 192, 192}, 1, [&](std::span<const radar::Echo> echoes, unsigned) {
    for (const radar::Echo& echo : echoes) {
      const double north = echo.range_m / std::cos(aspect.elevation_rad);
      if (echo.bounces > 1 && behind_wall.contains({echo.cross, north}))
        sum += static_cast<double>(echo.rcs_m2.power(radar::Polarization::Sum));
    }
  });
  return sum;
}

TEST(MultibounceReach, BringsWhatALargerAreaWould) {
  const scene::Scene scene = wall_behind_wall();
  const double all = landed(scene, {-100, -100, 100, 100}, {});
  ASSERT_GT(all, 0.0);
  const auto reach = multibounce_reach(scene, Viewpoint::distant(southern), behind_wall);
  EXPECT_NEAR(landed(scene, behind_wall, reach) / all, 1.0, 0.03);
  // As far as once was thought to be enough.
  EXPECT_LT(landed(scene, behind_wall, {32.0, 32.0}) / all, 0.01);
}

// Rays that are spared count for more. From far above, those that meet the wall are not aimed beyond the target.
TEST(MultibounceReach, RingsDoNotChangeTheMean) {
  const scene::Scene scene = wall_behind_wall();
  const double all = landed(scene, {-80, -60, 80, 72}, {}, steep_southern);
  for (const double before_m : {60.0, 120.0, 240.0})
    EXPECT_NEAR(landed(scene, behind_wall, {before_m, 40.0}, steep_southern) / all, 1.0, 0.03) << before_m;
}

TEST(MultibounceReach, EchoesNeverLandBeforeTheirEnds) {
  const scene::Scene scene = wall_behind_wall();
  const auto viewpoint = Viewpoint::distant(southern);
  const SceneGeometry geometry(scene, Footing::LevelPlane);
  const PathTracer tracer(geometry, surface_models(scene, 10e9), viewpoint, {.max_bounces = 8}, 3);
  const LaunchArea launch = launch_area(viewpoint, {-40, -80, 40, 60}, 0.5, 0.0, geometry.highest_m() + 1.0, {});
  std::size_t later = 0;
  tracer.trace_tiles(launch, 1, [&](TilePaths& tile, unsigned) {
    std::vector<PathStart> starts;
    for (const LaunchCell& cell : tile.cells()) starts.push_back({cell, 0, 0});
    tile.follow(starts);
    for (std::size_t start = 0; start < starts.size(); ++start) {
      const auto echoes = tile.echoes(0, start);
      if (echoes.empty() || echoes.front().bounces > 1) continue;
      for (const radar::Echo& echo : echoes.subspan(1)) {
        EXPECT_GT(echo.range_m, echoes.front().range_m);
        ++later;
      }
    }
  });
  EXPECT_GT(later, 50U);
}

TEST(MultibounceReach, FollowsHeightAndSlope) {
  scene::Scene scene = plain_scene(0.0);
  add_box(scene, {10, 10, 40}, {0, 0}, 0.5);
  const radar::Rectangle place{-10, -10, 10, 10};
  const auto before = [&](double elevation_deg) {
    return multibounce_reach(scene, Viewpoint::distant({0.0, radians_from_deg(elevation_deg)}), place).before_m;
  };
  EXPECT_NEAR(before(30.0), 80.0 / std::cos(radians_from_deg(30.0)), 1e-9);
  EXPECT_NEAR(before(45.0), 80.0, 1e-9);
  EXPECT_EQ(before(89.0), 1024.0);
  EXPECT_EQ(before(1.0), 1024.0);
  EXPECT_EQ(multibounce_reach(plain_scene(0.0), Viewpoint::distant(southern), place).before_m, 32.0);
}

// High ground is seen from a place as flatly as low ground from as far above it.
TEST(MultibounceReach, OfARadarAtAPlaceFollowsItsHeightAboveTheGround) {
  const radar::Rectangle place{-10, -10, 10, 10};
  const auto before = [&](float ground_m, double above_m) {
    scene::Scene scene = plain_scene(0.0, ground_m);
    add_box(scene, {10, 10, 40}, {0, 0}, 0.5);
    const double radar_m = static_cast<double>(ground_m) + above_m;
    return multibounce_reach(scene, Viewpoint::located({10.0, -4010.0, radar_m}), place).before_m;
  };
  // Farthest away are the northern corners, by 4020 m northwards and 20 m aside at most.
  const double over_ground_m = std::hypot(4020.0, 20.0), range_m = std::hypot(over_ground_m, 1000.0);
  const double nearer_m = range_m - 40.0 * range_m / 1000.0;
  const double expected_m = over_ground_m - std::sqrt(nearer_m * nearer_m - 1e6);
  EXPECT_NEAR(before(0.0F, 1000.0), expected_m, 1e-6);
  EXPECT_NEAR(before(2000.0F, 1000.0), expected_m, 1e-6);
  // One that stands lower than the ground sees none of it, be it far away or not.
  EXPECT_EQ(before(2000.0F, -10.0), 1024.0);
}

// 40 m of range are all of the ground between a place and the foot of a radar that is nearly above it, and no more.
TEST(MultibounceReach, EndsBelowTheRadar) {
  scene::Scene scene = plain_scene(0.0);
  add_box(scene, {10, 10, 40}, {0, 0}, 0.5);
  const auto reach = multibounce_reach(scene, Viewpoint::located({0.0, -90.0, 1000.0}), {-10, -10, 10, 10});
  EXPECT_NEAR(reach.before_m, std::hypot(10.0, 100.0), 1e-6);
}

TEST(MultibounceReach, EndsWhereNothingStands) {
  scene::Scene scene = plain_scene(0.0);
  scene.extent = {-50, -50, 50, 50};
  add_box(scene, {10, 20, 40}, {100, 0}, 0.5);
  const auto reach = multibounce_reach(scene, Viewpoint::distant(southern), {-10, -10, 10, 10});
  EXPECT_EQ(reach.within.west_m, -50.0);
  EXPECT_EQ(reach.within.south_m, -50.0);
  EXPECT_NEAR(reach.within.east_m, 100.0 + std::hypot(5.0, 10.0), 1e-4);
}

}  // namespace
}  // namespace sigmascape::trace
