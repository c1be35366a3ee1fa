#include "sigmascape/scene/obstacle_raster.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <numbers>

#include "sigmascape/base/interruption.h"
#include "sigmascape/scene/solid_mesh.h"

namespace sigmascape::scene {
namespace {

constexpr radar::GroundGrid cells{-10.0, 10.0, 2.0, 10, 10};

Scene empty_scene(float west_m = 0.0F, float east_m = 0.0F) {
  Scene scene;
  scene.extent = cells.extent();
  scene.terrain = {-10.0, 10.0, 20.0, Array2D<float>(2, 2)};
  for (const std::size_t row : {0U, 1U}) {
    scene.terrain.height_m(0, row) = west_m;
    scene.terrain.height_m(1, row) = east_m;
  }
  return scene;
}

TEST(ObstacleRaster, ClosedMeshesAreSolidWhereTheyCoverHalfACell) {
  Scene scene = empty_scene();
  scene.prototypes.push_back(box_mesh({4.0F, 4.8F, 7.0F}, 0));
  scene.instances.push_back({.x_m = 0.0F, .y_m = 0.0F});
  const auto map = obstacles_of(scene, cells);
  EXPECT_FLOAT_EQ(map.at({1.0, 1.0}).solid_top_m, 7.0F);
  EXPECT_FLOAT_EQ(map.at({-1.9, -1.9}).solid_top_m, 7.0F);
  EXPECT_EQ(map.at({0.5, 2.1}), radar::Obstacle{});  // a fifth of the cell
  EXPECT_EQ(map.at({2.1, 0.5}), radar::Obstacle{});
  EXPECT_EQ(map.at({50.0, 0.0}), radar::Obstacle{});
}

// Of its 18 edges four are open.
TEST(ObstacleRaster, AHouseWithoutItsUndersideIsSolid) {
  Scene scene = empty_scene();
  Mesh house = box_mesh({4.0F, 4.8F, 7.0F}, 0);
  const auto lies_on_the_ground = [&](const std::array<std::uint32_t, 3>& triangle) {
    return std::ranges::all_of(triangle, [&](std::uint32_t corner) { return house.vertices[corner].z <= 0.0F; });
  };
  ASSERT_EQ(std::erase_if(house.triangles, lies_on_the_ground), 2U);
  house.materials.resize(house.triangles.size());
  scene.prototypes.push_back(house);
  scene.instances.push_back({.x_m = 0.0F, .y_m = 0.0F});
  const auto map = obstacles_of(scene, cells);
  EXPECT_FLOAT_EQ(map.at({1.0, 1.0}).solid_top_m, 7.0F);
  EXPECT_EQ(map.at({1.0, 1.0}).crown_top_m, 0.0F);
}

TEST(ObstacleRaster, HeightsAreAboveTheGroundBelow) {
  Scene scene = empty_scene(0.0F, 4.0F);  // rises eastward by 0.2
  scene.prototypes.push_back(box_mesh({8.0F, 8.0F, 10.0F}, 0));
  scene.instances.push_back({.x_m = 0.0F, .y_m = 0.0F});
  const auto map = obstacles_of(scene, cells);
  // The highest of five points across the cell stands 0.2 m from its western edge.
  EXPECT_NEAR(map.at({-3.0, 0.0}).solid_top_m, 10.0 + 0.2 * 3.8, 1e-4);
  EXPECT_NEAR(map.at({3.0, 0.0}).solid_top_m, 10.0 - 0.2 * 2.2, 1e-4);
}

// A sheet of 8 m² in a cell of 4 m² between 3 m and 7 m: 8 / (2 · 4 · 4).
TEST(ObstacleRaster, OpenMeshesArePorousByTheirArea) {
  Scene scene = empty_scene();
  scene.prototypes.push_back({.name = "sheet",
                              .vertices = {{-1, 0, 3}, {1, 0, 3}, {1, 0, 7}, {-1, 0, 7}},
                              .triangles = {{0, 1, 2}, {0, 2, 3}},
                              .materials = {0, 0}});
  scene.instances.push_back({.x_m = 5.0F, .y_m = 5.0F});
  const auto map = obstacles_of(scene, cells);
  const radar::Obstacle sheet = map.at({5.0, 5.0});
  EXPECT_EQ(sheet.solid_top_m, 0.0F);
  EXPECT_FLOAT_EQ(sheet.crown_base_m, 3.0F);
  EXPECT_FLOAT_EQ(sheet.crown_top_m, 7.0F);
  EXPECT_NEAR(sheet.crown_extinction_per_m, 0.25, 1e-5);
}

/// As leaves are exported that are to be seen from both sides.
TEST(ObstacleRaster, SheetsThatAreThereTwiceArePorousOnce) {
  Scene scene = empty_scene();
  scene.prototypes.push_back({.name = "sheet",
                              .vertices = {{-1, 0, 3}, {1, 0, 3}, {1, 0, 7}, {-1, 0, 7}},
                              .triangles = {{0, 1, 2}, {0, 2, 3}, {2, 1, 0}, {3, 2, 0}},
                              .materials = {0, 0, 0, 0}});
  scene.instances.push_back({.x_m = 5.0F, .y_m = 5.0F});
  const auto map = obstacles_of(scene, cells);
  const radar::Obstacle sheet = map.at({5.0, 5.0});
  EXPECT_EQ(sheet.solid_top_m, 0.0F);
  EXPECT_NEAR(sheet.crown_extinction_per_m, 0.25, 1e-5);
}

TEST(ObstacleRaster, WhatIsStatedOfAMeshCountsInsteadOfItsEdges) {
  Scene scene = empty_scene();
  Mesh roof{.name = "roof",
            .vertices = {{-2, -2, 4}, {2, -2, 4}, {2, 2, 4}, {-2, 2, 4}},
            .triangles = {{0, 1, 2}, {0, 2, 3}},
            .materials = {0, 0}};
  roof.is_solid = true;
  Mesh deck = box_mesh({4.0F, 4.0F, 1.0F}, 0);
  deck.is_solid = false;
  scene.prototypes = {roof, deck};
  scene.instances.push_back({.prototype = 0, .x_m = -4.0F, .y_m = 0.0F});
  scene.instances.push_back({.prototype = 1, .x_m = 4.0F, .y_m = 0.0F, .lift_m = 6.0F});
  const auto map = obstacles_of(scene, cells);
  EXPECT_FLOAT_EQ(map.at({-3.0, 1.0}).solid_top_m, 4.0F);
  EXPECT_EQ(map.at({-3.0, 1.0}).crown_top_m, 0.0F);
  EXPECT_EQ(map.at({5.0, 1.0}).solid_top_m, 0.0F);
  EXPECT_FLOAT_EQ(map.at({5.0, 1.0}).crown_base_m, 6.0F);
  EXPECT_FLOAT_EQ(map.at({5.0, 1.0}).crown_top_m, 7.0F);
}

// An ellipsoid of 3 m by 2 m by 1.5 m about a point 5 m up, doubled: what cells hold of it together is κ V, κ by its
// own metres or by those of the world.
TEST(ObstacleRaster, CrownsThatAreMediaInterceptWhatTheyDoInTheScene) {
  constexpr double volume_m3 = 4.0 / 3.0 * std::numbers::pi * 6.0 * 4.0 * 3.0;
  for (const bool grows : {false, true}) {
    Scene scene = empty_scene();
    scene.prototypes.push_back({});
    scene.crowns.push_back(
        {.prototype = 0,
         .shape = {{0.0F, 0.0F, 5.0F}, {3.0F, 2.0F, 1.5F}},
         .medium = scene.material_index(
             {.name = "medium", .model = scatter::CrownParameters{.extinction_per_m = 0.4}, .source = {}}),
         .grows_with_tree = grows});
    scene.instances.push_back({.yaw_rad = 1.57079633F, .scale = {2.0F, 2.0F, 2.0F}});
    const auto map = obstacles_of(scene, cells);
    double depth_m2 = 0.0;
    for (const radar::Obstacle& cell : map.obstacles.values()) {
      depth_m2 += static_cast<double>(cell.crown_extinction_per_m) *
                  static_cast<double>(cell.crown_top_m - cell.crown_base_m) * cells.cell_area_m2();
      EXPECT_EQ(cell.solid_top_m, 0.0F);
    }
    EXPECT_NEAR(depth_m2 / volume_m3, grows ? 0.2 : 0.4, 0.004);
    EXPECT_NEAR(map.at({0.5, 0.5}).crown_top_m, 13.0, 0.02);
    EXPECT_NEAR(map.at({0.5, 0.5}).crown_base_m, 7.0, 0.02);
    // Turned by a quarter, it is long from north to south.
    EXPECT_GT(map.at({0.5, 5.0}).crown_top_m, 0.0F);
    EXPECT_EQ(map.at({5.0, 0.5}).crown_top_m, 0.0F);
  }
}

// A sheet at 3 m and 7 m that reaches 10^30 m beyond the cells on two sides.
TEST(ObstacleRaster, MeshesMayReachHoweverFarBeyondTheCells) {
  Scene scene = empty_scene();
  scene.prototypes.push_back({.name = "sheet",
                              .vertices = {{-8, -8, 3}, {1e30F, -8, 3}, {-8, 1e30F, 3}},
                              .triangles = {{0, 1, 2}},
                              .materials = {0}});
  scene.instances.push_back({});
  scene.instances.push_back({.lift_m = 4.0F});
  const auto map = obstacles_of(scene, cells);
  EXPECT_NEAR(map.at({9.0, 9.0}).crown_base_m, 3.0, 1e-4);
  EXPECT_NEAR(map.at({9.0, 9.0}).crown_top_m, 7.0, 1e-4);
  EXPECT_EQ(map.at({-9.5, 0.0}), radar::Obstacle{});
}

// Each loop by itself: over buildings and instances where there are no cells, over cells where nothing stands.
TEST(ObstacleRaster, CanBeToldToStop) {
  constexpr radar::GroundGrid no_cells{-10.0, 10.0, 2.0, 0, 0};
  const Scene nothing = empty_scene();
  Scene building = empty_scene(), instance = empty_scene();
  building.buildings.mesh = box_mesh({4.0F, 4.0F, 7.0F}, 0);
  instance.prototypes.push_back({.name = "nothing", .vertices = {}, .triangles = {}, .materials = {}});
  instance.instances.push_back({});
  EXPECT_NO_THROW((void)obstacles_of(instance, no_cells));
  const Interruption stop([] { return true; });
  EXPECT_NO_THROW((void)obstacles_of(nothing, no_cells)) << "there is no loop to end";
  EXPECT_THROW((void)obstacles_of(building, no_cells), Interrupted);
  EXPECT_THROW((void)obstacles_of(instance, no_cells), Interrupted);
  EXPECT_THROW((void)obstacles_of(nothing, cells), Interrupted);
}

// The scene is 20 m wide: of cells of 3 m the seventh stands half outside, and holds what stands inside.
TEST(ObstacleRaster, OverAllOfASceneLeavesNoRimOut) {
  Scene scene = empty_scene();
  scene.prototypes.push_back(box_mesh({4.0F, 4.0F, 7.0F}, 0));
  scene.instances.push_back({.x_m = 9.0F, .y_m = -9.0F});
  const auto map = obstacles_of(scene, 3.0);
  EXPECT_EQ(map.grid.columns, 7U);
  EXPECT_FLOAT_EQ(map.at({9.0, -9.0}).solid_top_m, 7.0F);
  EXPECT_EQ(obstacles_of(scene, 2.0).grid.columns, 10U);
}

}  // namespace
}  // namespace sigmascape::scene
