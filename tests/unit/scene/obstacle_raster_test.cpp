#include "sigmascape/scene/obstacle_raster.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>
#include <tuple>
#include <utility>

#include "sigmascape/base/interruption.h"
#include "sigmascape/base/units.h"
#include "sigmascape/scene/solid_mesh.h"
#include "sigmascape/scene/tree_mesh.h"

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

/// A sheet of 8 m² across a cell of 4 m² between 3 m and 7 m, over the middle one of five rows of parts. Each of these
/// has κ = 1.6 / (2 · 0.16 · 4): along the row one line of five passes a depth of 2.5, across it all pass 0.5, and
/// upwards one of five passes 5. Where there are `like_it` such cells in a row, lines along it pass them all.
double extinction_of_sheet_per_m(double like_it = 1.0) {
  const double along = -std::log((4.0 + std::exp(-2.5 * like_it)) / 5.0) / like_it, across = 0.5,
               upwards = -std::log((4.0 + std::exp(-5.0)) / 5.0);
  return (along / 2.0 + across / 2.0 + upwards / 4.0) / 3.0;
}

/// Upright, so long from west to east.
Mesh upright_sheet(float length_m) {
  const float half = length_m / 2.0F;
  return {.name = "sheet",
          .vertices = {{-half, 0, 3}, {half, 0, 3}, {half, 0, 7}, {-half, 0, 7}},
          .triangles = {{0, 1, 2}, {0, 2, 3}},
          .materials = {0, 0}};
}

TEST(ObstacleRaster, OpenMeshesArePorousByTheirArea) {
  Scene scene = empty_scene();
  scene.prototypes.push_back(upright_sheet(2.0F));
  scene.instances.push_back({.x_m = 5.0F, .y_m = 5.0F});
  const auto map = obstacles_of(scene, cells);
  const radar::Obstacle sheet = map.at({5.0, 5.0});
  EXPECT_EQ(sheet.solid_top_m, 0.0F);
  EXPECT_FLOAT_EQ(sheet.crown_base_m, 3.0F);
  EXPECT_FLOAT_EQ(sheet.crown_top_m, 7.0F);
  EXPECT_NEAR(sheet.crown_extinction_per_m, extinction_of_sheet_per_m(), 0.01 * extinction_of_sheet_per_m());
}

// Over three cells and a part of a fourth, through all of which lines along the sheet go: from west to east, and
// turned.
TEST(ObstacleRaster, LinesGoOnThroughTheNextCells) {
  const double of_three = extinction_of_sheet_per_m(3.0), of_two = extinction_of_sheet_per_m(2.0);
  for (const bool turned : {false, true}) {
    Scene scene = empty_scene();
    scene.prototypes.push_back(upright_sheet(6.4F));
    scene.instances.push_back({.x_m = 1.2F, .y_m = 1.0F});
    if (turned) scene.instances[0] = {.x_m = 1.0F, .y_m = 1.2F, .yaw_rad = 1.57079633F};
    const auto map = obstacles_of(scene, cells);
    EXPECT_NEAR(map.at({1.0, 1.0}).crown_extinction_per_m, of_three, 0.02 * of_three) << turned;
    const Vec2d end = turned ? Vec2d{1.0, -1.0} : Vec2d{-1.0, 1.0};
    EXPECT_NEAR(map.at(end).crown_extinction_per_m, of_two, 0.02 * of_two) << turned;
  }
}

// One leaf over everything, as a canopy that was drawn as one face: by Cauchy's mean it has a depth of a half upwards,
// wherever its slope carries it.
TEST(ObstacleRaster, SheetsHideWhatLiesBelowThemHoweverTheyAreTilted) {
  for (const float slope : {0.0F, 0.02F, 0.3F}) {
    Scene scene = empty_scene();
    scene.prototypes.push_back({.name = "canopy",
                                .vertices = {{-20, -20, 10.0F - 20.0F * slope},
                                             {20, -20, 10.0F + 20.0F * slope},
                                             {20, 20, 10.0F + 20.0F * slope},
                                             {-20, 20, 10.0F - 20.0F * slope}},
                                .triangles = {{0, 1, 2}, {0, 2, 3}},
                                .materials = {0, 0}});
    scene.instances.push_back({});
    for (const double cell_m : {2.0, 4.0}) {
      const auto count = static_cast<std::size_t>(16.0 / cell_m);
      const auto map = obstacles_of(scene, {-8.0, 8.0, cell_m, count, count});
      double depth = 0.0;
      for (const radar::Obstacle& cell : map.obstacles.values())
        depth += static_cast<double>(cell.crown_extinction_per_m * (cell.crown_top_m - cell.crown_base_m));
      depth /= static_cast<double>(count * count);
      EXPECT_LT(depth, 0.55) << slope << ", " << cell_m << " m";
      EXPECT_GT(depth, slope == 0.0F ? 0.45 : 0.3) << slope << ", " << cell_m << " m";
    }
  }
}

TEST(ObstacleRaster, WhatLiesOnOrBelowTheGroundHidesNothing) {
  for (const float lift_m : {0.0F, -1.0F, -30.0F}) {
    Scene scene = empty_scene();
    scene.prototypes.push_back({.name = "carpet",
                                .vertices = {{-8, -8, 0}, {8, -8, 0}, {8, 8, 0}, {-8, 8, 0}},
                                .triangles = {{0, 1, 2}, {0, 2, 3}},
                                .materials = {0, 0}});
    scene.prototypes.push_back(tree_mesh(TreeForm::Conifer, {0, 1}, 1));
    scene.instances.push_back({.prototype = 0, .lift_m = lift_m});
    scene.instances.push_back({.prototype = 1, .lift_m = -30.0F});
    for (const double cell_m : {0.5, 2.0}) {
      const auto count = static_cast<std::size_t>(20.0 / cell_m);
      const auto map = obstacles_of(scene, {-10.0, 10.0, cell_m, count, count});
      EXPECT_TRUE(std::ranges::all_of(map.obstacles.values(),
                                      [](const radar::Obstacle& cell) { return cell == radar::Obstacle{}; }))
          << lift_m << ", " << cell_m;
    }
  }
}

// A bush of 0.3 m in a wide cell, and surfaces without area, which are nowhere.
TEST(ObstacleRaster, SmallCrownsAreFoundAndNothingIsNot) {
  Scene scene = empty_scene();
  scene.prototypes.push_back(
      {.name = "line", .vertices = {{-1, 0, 9}, {0, 0, 9}, {1, 0, 9}}, .triangles = {{0, 1, 2}}, .materials = {0}});
  scene.crowns.push_back(
      {.prototype = 0,
       .shape = {{0.0F, 0.0F, 0.3F}, {0.15F, 0.15F, 0.15F}},
       .medium = scene.material_index({.name = "medium", .model = scatter::CrownParameters{}, .source = {}})});
  for (int i = 0; i < 8; ++i)
    scene.instances.push_back(
        {.x_m = -9.0F + 2.0F * static_cast<float>(i) + 0.11F * static_cast<float>(i), .y_m = 0.93F});
  const auto map = obstacles_of(scene, radar::GroundGrid{-10.0, 10.0, 0.4, 50, 50});
  std::size_t found = 0;
  for (const Instance& instance : scene.instances) {
    float top_m = 0.0F;
    for (const double east : {-0.15, 0.15}) {
      for (const double north : {-0.15, 0.15})
        top_m = std::max(
            top_m,
            map.at({static_cast<double>(instance.x_m) + east, static_cast<double>(instance.y_m) + north}).crown_top_m);
    }
    found += top_m > 0.0F && top_m < 1.0F ? 1 : 0;
  }
  EXPECT_EQ(found, scene.instances.size());
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
  EXPECT_NEAR(sheet.crown_extinction_per_m, extinction_of_sheet_per_m(), 0.01 * extinction_of_sheet_per_m());
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

// An ellipsoid of 3 m by 2 m by 1.5 m about a point 5 m up, doubled: what cells hold of one so thin that gaps beside it
// make no difference is κ V together, κ by its own metres or by those of the world.
TEST(ObstacleRaster, CrownsThatAreMediaInterceptWhatTheyDoInTheScene) {
  constexpr double volume_m3 = 4.0 / 3.0 * std::numbers::pi * 6.0 * 4.0 * 3.0;
  for (const bool grows : {false, true}) {
    Scene scene = empty_scene();
    scene.prototypes.push_back({});
    scene.crowns.push_back(
        {.prototype = 0,
         .shape = {{0.0F, 0.0F, 5.0F}, {3.0F, 2.0F, 1.5F}},
         .medium = scene.material_index(
             {.name = "medium", .model = scatter::CrownParameters{.extinction_per_m = 0.0004}, .source = {}}),
         .grows_with_tree = grows});
    scene.instances.push_back({.yaw_rad = 1.57079633F, .scale = {2.0F, 2.0F, 2.0F}});
    const auto map = obstacles_of(scene, cells);
    double depth_m2 = 0.0;
    for (const radar::Obstacle& cell : map.obstacles.values()) {
      depth_m2 += static_cast<double>(cell.crown_extinction_per_m) *
                  static_cast<double>(cell.crown_top_m - cell.crown_base_m) * cells.cell_area_m2();
      EXPECT_EQ(cell.solid_top_m, 0.0F);
    }
    EXPECT_NEAR(depth_m2 / volume_m3, grows ? 0.0002 : 0.0004, 4e-6);
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

/// Of lines that rise from the ground, as everything stands above it.
bool meets(Vec3f a, Vec3f b, Vec3f c, Vec3f origin, Vec3f direction) {
  const Vec3f along = b - a, across = c - a, p = cross(direction, across);
  const float determinant = dot(along, p);
  if (determinant == 0.0F) return false;
  const Vec3f from_a = origin - a, q = cross(from_a, along);
  const float u = dot(from_a, p) / determinant, v = dot(direction, q) / determinant;
  return u >= 0.0F && v >= 0.0F && u + v <= 1.0F;
}

/// The ground about a tree at the origin that does not see the radar in the north, in m², at points of a lattice.
class Shadow {
 public:
  Shadow(const Mesh& tree, double elevation_rad) : tree_(tree), slope_(std::tan(elevation_rad)) {
    for (const Vec3f& vertex : tree.vertices) {
      tall_m_ = std::max(tall_m_, static_cast<double>(vertex.z));
      reach_m_ = std::max(reach_m_, static_cast<double>(std::hypot(vertex.x, vertex.y)));
    }
  }

  [[nodiscard]] double by_rays() const {
    return sum([&](Vec2d at) {
      const Vec3f from = Vec3d{at.x, at.y, 0.0}.to<float>(), towards = Vec3d{0.0, 1.0, slope_}.to<float>();
      return std::ranges::any_of(tree_.triangles, [&](const auto& t) {
        return meets(tree_.vertices[t[0]], tree_.vertices[t[1]], tree_.vertices[t[2]], from, towards);
      });
    });
  }

  [[nodiscard]] double by(const radar::ObstacleMap& map) const {
    constexpr double step_m = 0.1;
    return sum([&](Vec2d at) {
      double depth = 0.0;
      for (double y = 0.0; y * slope_ < tall_m_; y += step_m) {
        const radar::Obstacle obstacle = map.at(at + Vec2d{0.0, y});
        const double z = y * slope_;
        if (z > static_cast<double>(obstacle.crown_base_m) && z < static_cast<double>(obstacle.crown_top_m))
          depth += static_cast<double>(obstacle.crown_extinction_per_m) * step_m * std::hypot(1.0, slope_);
      }
      return 1.0 - std::exp(-depth);
    });
  }

 private:
  [[nodiscard]] double sum(const auto& hidden) const {
    constexpr double lattice_m = 0.37;
    double all = 0.0;
    for (double x = -reach_m_ - 4.0; x < reach_m_ + 4.0; x += lattice_m) {
      for (double y = -reach_m_ - 4.0 - tall_m_ / slope_; y < reach_m_ + 4.0; y += lattice_m)
        all += static_cast<double>(hidden({x, y})) * lattice_m * lattice_m;
    }
    return all;
  }

  const Mesh& tree_;
  double slope_, tall_m_ = 0.0, reach_m_ = 0.0;
};

// Leaves spread evenly over their cells would hide a quarter to two thirds more than rays find, on cells of 2 m and 4
// m.
TEST(ObstacleRaster, ATreeHidesAsMuchAsRaysFind) {
  for (const TreeForm form : {TreeForm::Broadleaf, TreeForm::Conifer}) {
    Scene scene = empty_scene();
    scene.prototypes.push_back(tree_mesh(form, {0, 1}, 1));
    scene.instances.push_back({});
    const Mesh& tree = scene.prototypes.front();
    for (const double elevation_deg : {13.0, 35.0}) {
      const Shadow shadow(tree, radians_from_deg(elevation_deg));
      const double rays_m2 = shadow.by_rays();
      for (const auto& [cell_m, most] : {std::pair(0.4, 1.05), {1.0, 1.1}, {2.0, 1.12}, {4.0, 1.15}, {8.0, 1.15}}) {
        const auto count = static_cast<std::size_t>(std::lround(32.0 / cell_m));
        // Trees do not stand where cells meet.
        const auto map = obstacles_of(scene, {-16.0 - 0.3 * cell_m, 16.0 + 0.4 * cell_m, cell_m, count, count});
        const double ratio = shadow.by(map) / rays_m2;
        EXPECT_GT(ratio, 0.92) << scene.prototypes.front().name << ", " << cell_m << " m at " << elevation_deg;
        EXPECT_LT(ratio, most) << scene.prototypes.front().name << ", " << cell_m << " m at " << elevation_deg;
      }
    }
  }
}

// Rows of cells are found in strips and pieces of grids by themselves; of a wood across their edges all hold the same.
TEST(ObstacleRaster, PiecesOfAGridHoldWhatItHolds) {
  Scene scene = empty_scene();
  scene.prototypes.push_back(tree_mesh(TreeForm::Broadleaf, {0, 1}, 1));
  scene.prototypes.push_back(box_mesh({3.0F, 5.0F, 7.0F}, 0));
  for (std::uint32_t i = 0; i < 600; ++i) {
    const auto column = static_cast<float>(i % 11), row = static_cast<float>(i / 11);
    scene.instances.push_back(
        {.prototype = i % 17 == 0 ? 1U : 0U, .x_m = 3.1F * column - 16.0F, .y_m = 3.0F * row - 81.0F});
  }
  // Strips have 128 and 16 rows.
  for (const auto& [cell_m, first, count] : {std::tuple(0.5, 40UL, 120UL), {4.0, 5UL, 20UL}}) {
    const auto columns = static_cast<std::size_t>(32.0 / cell_m), rows = static_cast<std::size_t>(160.0 / cell_m);
    const auto whole = obstacles_of(scene, {-16.0, 80.0, cell_m, columns, rows});
    const auto piece =
        obstacles_of(scene, {0.0, 80.0 - static_cast<double>(first) * cell_m, cell_m, columns / 4, count});
    for (std::size_t row = 0; row < count; ++row) {
      for (std::size_t column = 0; column < columns / 4; ++column) {
        EXPECT_EQ(piece.obstacles(column, row), whole.obstacles(column + columns / 2, row + first))
            << cell_m << " m, " << column << ", " << row;
      }
    }
  }
}

TEST(ObstacleRaster, TakesMemoryByTheStrip) {
  const double few = obstacle_raster_bytes({0.0, 0.0, 2.0, 1024, 64}),
               many = obstacle_raster_bytes({0.0, 0.0, 2.0, 1024, 1024});
  EXPECT_EQ(many - few, 960.0 * 1024.0 * static_cast<double>(sizeof(radar::Obstacle)));
  // 16 bytes a cell; of a strip of 32 rows twice that and 100 for roofs; of it and a cell about it 25 parts of 24.
  EXPECT_NEAR(many, 1024.0 * 1024.0 * 16.0 + 1024.0 * 32.0 * 132.0 + 1026.0 * 34.0 * 600.0, 0.002 * many);
}

// Over buildings and instances where there are no cells, over cells where nothing stands.
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
