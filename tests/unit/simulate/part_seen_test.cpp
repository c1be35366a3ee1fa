#include "sigmascape/simulate/part_seen.h"

#include <cmath>
#include <gtest/gtest.h>
#include <random>

#include "physics/level_scene.h"

#include "sigmascape/base/units.h"
#include "sigmascape/scene/obstacle_raster.h"
#include "sigmascape/scene/solid_mesh.h"

namespace sigmascape::simulate {
namespace {

/// Level, but for a ridge of 30 m that runs from west to east 100 m north of the middle when asked for.
terrain::HeightField ground(bool with_ridge) {
  terrain::HeightField terrain{
      .west_m = -500.0, .north_m = 500.0, .spacing_m = 10.0, .height_m = Array2D<float>(101, 101, 5.0F)};
  for (std::size_t column = 0; with_ridge && column < 101; ++column) terrain.height_m(column, 40) = 35.0F;
  return terrain;
}

/// One kind of obstacle over a block from 20 to 40 m north of the middle.
radar::ObstacleMap block_of(const radar::Obstacle& obstacle) {
  radar::ObstacleMap map{.grid = {-100.0, 100.0, 2.0, 100, 100}, .obstacles = Array2D<radar::Obstacle>(100, 100)};
  for (std::size_t row = 0; row < 100; ++row) {
    for (std::size_t column = 0; column < 100; ++column) {
      const double north_m = map.grid.centre_of(column, row).y;
      if (north_m > 20.0 && north_m < 40.0) map.obstacles(column, row) = obstacle;
    }
  }
  return map;
}

/// To the north, so high above the middle.
Vec3d radar_at(double elevation_deg) {
  return {0.0, 5000.0 * std::cos(radians_from_deg(elevation_deg)),
          5.0 + 5000.0 * std::sin(radians_from_deg(elevation_deg))};
}

TEST(TargetSight, ends_at_a_ridge) {
  const auto ridge = ground(true), level = ground(false);
  // The ridge stands 100 m off: it hides what lies lower than 30 m − 100 m · tan ψ.
  const double hidden_below_m = 30.0 - 100.0 * std::tan(radians_from_deg(10.0));
  for (const double height_m : {1.0, hidden_below_m - 0.8, hidden_below_m + 0.8, 40.0}) {
    const Vec3d point{0.0, 0.0, 5.0 + height_m};
    EXPECT_EQ(part_seen({ridge}, radar_at(10.0) + Vec3d{0.0, 0.0, height_m}, point),
              height_m > hidden_below_m ? 1.0 : 0.0)
        << height_m;
    EXPECT_EQ(part_seen({level}, radar_at(10.0), point), 1.0);
  }
}

TEST(TargetSight, ends_at_a_house_that_is_taller_than_the_line) {
  const auto level = ground(false);
  // At 45° the line has risen to 20 … 40 m over the block.
  const Vec3d radar = radar_at(45.0), point{0.0, 0.0, 5.0};
  const auto tall = block_of({.solid_top_m = 30.0F}), low = block_of({.solid_top_m = 15.0F});
  EXPECT_EQ(part_seen({level, &tall}, radar, point), 0.0);
  EXPECT_EQ(part_seen({level, &low}, radar, point), 1.0);
  // Beside the houses, and in front of them as seen from the radar.
  EXPECT_EQ(part_seen({level, &tall}, radar, {150.0, 0.0, 5.0}), 1.0);
  EXPECT_EQ(part_seen({level, &tall}, radar, {0.0, 50.0, 5.0}), 1.0);
}

TEST(TargetSight, is_not_had_from_within_a_house) {
  const auto level = ground(false);
  const auto houses = block_of({.solid_top_m = 12.0F});
  // Just behind the wall that faces the radar, in the middle, and on the roof.
  for (const double north_m : {39.5, 38.5, 30.0}) {
    EXPECT_EQ(part_seen({level, &houses}, radar_at(45.0), {0.0, north_m, 7.0}), 0.0) << north_m;
    EXPECT_EQ(part_seen({level, &houses}, radar_at(45.0), {0.0, north_m, 17.0 - 1e-9}), 1.0) << north_m;
  }
}

/// Squares over a slope are as high above all of it as the roof is above their lowest ground.
TEST(TargetSight, is_had_from_a_roof_over_sloping_ground) {
  const double slope = std::tan(radians_from_deg(10.0)), side_m = 16.0, lift_m = 9.37;
  auto scene = physics_test::level_scene(scatter::Material{.name = "stone", .model = {}, .source = {}}, 400.0);
  scene.terrain = {-200.0, 200.0, 10.0, Array2D<float>(41, 41, 0.0F)};
  for (std::size_t row = 0; row < 41; ++row) {
    for (std::size_t column = 0; column < 41; ++column)
      scene.terrain.height_m(column, row) = static_cast<float>(100.0 + slope * 10.0 * static_cast<double>(column));
  }
  const auto side = static_cast<float>(side_m);
  scene.prototypes.push_back(scene::box_mesh({side, side, static_cast<float>(lift_m)}, 0));
  scene.instances.push_back({});
  const auto obstacles = scene::obstacles_of(scene, {-40.0, 40.0, 2.0, 40, 40});
  const trace::SceneGeometry geometry(scene, trace::Footing::Terrain);
  const auto surfaces = trace::surface_models(scene, 10e9);
  const double roof_m = scene.terrain.height_at({0.0, 0.0}) + lift_m;
  for (const double azimuth_deg : {0.0, 60.0, 90.0, 200.0, 270.0}) {
    for (const double elevation_deg : {12.0, 45.0}) {
      for (const double across_m : {-7.5, -3.0, 0.0, 5.2, 7.9}) {
        const Vec3d point{across_m, 0.3 * across_m, roof_m + 0.01};
        const Vec3d radar =
            radar::position_seeing(point, radians_from_deg(azimuth_deg), radians_from_deg(elevation_deg), 20e3);
        ASSERT_EQ(part_seen(geometry, surfaces, radar, point), 1.0);
        EXPECT_EQ(part_seen({scene.terrain, &obstacles}, radar, point), 1.0)
            << azimuth_deg << " " << elevation_deg << " " << across_m;
        const Vec3d within = point - Vec3d{0.0, 0.0, 3.0};
        EXPECT_EQ(part_seen({scene.terrain, &obstacles}, radar, within), 0.0);
      }
    }
  }
}

TEST(TargetSight, is_dimmed_by_the_crown_that_it_stands_in) {
  const auto level = ground(false);
  const auto crowns = block_of({.crown_base_m = 0.0F, .crown_top_m = 50.0F, .crown_extinction_per_m = 0.1F});
  const double cosine = std::cos(radians_from_deg(10.0));
  // To the edge at 40 m, whatever the steps: in the middle of a square of 2 m and of that at the edge.
  for (const double north_m : {31.0, 39.0})
    EXPECT_NEAR(part_seen({level, &crowns}, radar_at(10.0), {0.0, north_m, 6.0}),
                std::exp(-0.1 * (40.0 - north_m) / cosine), 1e-3)
        << north_m;
}

/// Looking for it takes as long as the map is large, and targets are many.
TEST(TargetSight, finds_what_is_highest_once_for_all_targets) {
  const auto ridge = ground(true);
  const auto houses = block_of({.solid_top_m = 12.0F});
  EXPECT_EQ((Obstructions{ridge}.highest_m), 35.0);
  Obstructions obstructions{ridge, &houses};
  EXPECT_EQ(obstructions.highest_m, 35.0 + 12.0);
  const Vec3d point{0.0, 0.0, 6.0};
  ASSERT_EQ(part_seen(obstructions, radar_at(10.0), point), 0.0);
  obstructions.highest_m = 0.0;
  EXPECT_EQ(part_seen(obstructions, radar_at(10.0), point), 1.0) << "a line above what is said to be highest is free";
}

/// The line crosses 20 m of crowns: e^(−κ · 20 m / cos ψ).
TEST(TargetSight, fades_in_crowns) {
  const auto level = ground(false);
  const double elevation_deg = 10.0, kappa = 0.05;
  const auto crowns =
      block_of({.crown_base_m = 0.5F, .crown_top_m = 20.0F, .crown_extinction_per_m = static_cast<float>(kappa)});
  EXPECT_NEAR(part_seen({level, &crowns}, radar_at(elevation_deg), {0.0, 0.0, 5.5}),
              std::exp(-kappa * 20.0 / std::cos(radians_from_deg(elevation_deg))), 1e-3);
  // At 60° the line is above them all.
  EXPECT_EQ(part_seen({level, &crowns}, radar_at(60.0), {0.0, 0.0, 5.5}), 1.0);
}

/// On level ground, on a slope and where squares are twisted; none of them so steep that it would hide a point.
TEST(TargetSight, of_rays_reaches_points_that_lie_on_the_ground) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> place(-180.0, 180.0);
  std::uniform_real_distribution<float> bump(0.0F, 2.0F);
  for (const char* ground : {"level", "sloping", "rough"}) {
    auto scene = physics_test::level_scene(scatter::Material{.name = "ground", .model = {}, .source = {}}, 400.0);
    scene.terrain = {-200.0, 200.0, 10.0, Array2D<float>(41, 41, 0.0F)};
    for (std::size_t row = 0; row < scene.terrain.height_m.rows(); ++row) {
      for (std::size_t column = 0; column < scene.terrain.height_m.columns(); ++column) {
        float& height_m = scene.terrain.height_m(column, row);
        if (ground == std::string("sloping")) height_m = 700.0F + 3.7F * static_cast<float>(column);
        if (ground == std::string("rough")) height_m = 300.0F + bump(random);
      }
    }
    const trace::SceneGeometry geometry(scene, trace::Footing::Terrain);
    const auto surfaces = trace::surface_models(scene, 10e9);
    for (int i = 0; i < 200; ++i) {
      const Vec2d on_map{place(random), place(random)};
      const Vec3d point{on_map.x, on_map.y, scene.terrain.height_at(on_map)};
      EXPECT_EQ(part_seen(geometry, surfaces, point + radar_at(40.0), point), 1.0) << ground << " " << i;
      const Vec3d dug_in = point - Vec3d{0.0, 0.0, 3.0};
      EXPECT_EQ(part_seen(geometry, surfaces, point + radar_at(40.0), dug_in), 1.0) << ground << " " << i;
      EXPECT_EQ(part_seen({scene.terrain}, point + radar_at(40.0), dug_in), 1.0) << ground << " " << i;
    }
  }
}

/// Straight down through 8 m of a crown: as the ground beneath, by e^(−κ · 8 m), and once more on the way back where
/// the medium has no gaps to share. Obstacles say the same.
TEST(TargetSight, of_rays_fades_in_crowns) {
  const double kappa = 0.2;
  for (const bool shares_gaps : {true, false}) {
    auto scene = physics_test::level_scene(scatter::Material{.name = "ground", .model = {}, .source = {}}, 400.0);
    const scatter::CrownParameters leaves{.extinction_per_m = kappa, .shares_gaps = shares_gaps};
    const auto medium = scene.material_index({.name = "leaves", .model = leaves, .source = {}});
    scene.prototypes.push_back(scene::wall_mesh(0.001F, 0.001F, 0));
    scene.crowns.push_back({.prototype = 0, .shape = {{0.0F, 0.0F, 6.0F}, {10.0F, 10.0F, 4.0F}}, .medium = medium});
    scene.instances.push_back({.x_m = 0.0F, .y_m = 0.0F});
    const trace::SceneGeometry geometry(scene, trace::Footing::Terrain);
    const auto surfaces = trace::surface_models(scene, 10e9);
    const double ground_m = scene.terrain.height_at({0.0, 0.0}), ways = shares_gaps ? 1.0 : 2.0;
    EXPECT_NEAR(part_seen(geometry, surfaces, {0.0, 0.0, ground_m + 400.0}, {0.0, 0.0, ground_m}),
                std::exp(-ways * kappa * 8.0), 1e-3);
    const auto obstacles = scene::obstacles_of(scene, {-20.0, 20.0, 1.0, 40, 40});
    EXPECT_NEAR(static_cast<double>(obstacles.at({0.5, 0.5}).crown_extinction_per_m), ways * kappa,
                0.02 * ways * kappa);
  }
}

TEST(TargetSight, of_rays_ends_at_the_radar) {
  const auto scene = physics_test::level_scene(scatter::Material{.name = "ground", .model = {}, .source = {}}, 400.0);
  const trace::SceneGeometry geometry(scene, trace::Footing::Terrain);
  const auto surfaces = trace::surface_models(scene, 10e9);
  EXPECT_EQ(part_seen(geometry, surfaces, {0.0, 0.0, 400.0}, {50.0, 20.0, 710.0}), 1.0);
}

TEST(SeenTargets, leave_out_what_is_hidden_and_weaken_what_fades) {
  std::vector<radar::Target> targets(3);
  targets[0].rcs_m2 = radar::Channels{8.0F, 4.0F, 2.0F, 1.0F};
  targets[1].rcs_m2 = targets[0].rcs_m2;
  targets[2].rcs_m2 = radar::RcsTable{{0.0}, {0.0}, {1e10}, {{8.0F, 4.0F, 2.0F, 1.0F}}};
  targets[1].track = radar::Track::straight({1.0, 0.0, 0.0});
  targets[2].track = radar::Track::straight({0.0, 0.0, 0.0}, {0.5, 0.0, 0.0});
  const auto seen = seen_targets(targets, 1.0, [](Vec3d position) { return position.x; });
  ASSERT_EQ(seen.size(), 2U);
  EXPECT_EQ(std::get<radar::Channels>(seen[0].rcs_m2), (radar::Channels{8.0F, 4.0F, 2.0F, 1.0F}));
  EXPECT_EQ(radar::rcs_of(seen[1], {0.0, 0.0, 100.0}, 1e10, {}), (radar::Channels{4.0F, 2.0F, 1.0F, 0.5F}));
}

}  // namespace
}  // namespace sigmascape::simulate
