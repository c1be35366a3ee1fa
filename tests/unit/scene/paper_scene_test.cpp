#include "sigmascape/scene/paper_scene.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <map>
#include <set>

#include "sigmascape/base/error.h"
#include "sigmascape/scene/solid_mesh.h"
#include "sigmascape/scene/tree_mesh.h"
#include "sigmascape/scene/vehicle_mesh.h"

namespace sigmascape::scene {
namespace {

using Corners = std::vector<Vec2d>;

bool is_tree(const Scene& scene, const Instance& instance) {
  return scene.prototypes[instance.prototype].vertices.size() == tree_vertex_count;
}

Vec2d place_of(const Instance& instance) {
  return Vec2d{static_cast<double>(instance.x_m), static_cast<double>(instance.y_m)};
}

const std::string& ground_name(const Scene& scene, Vec2d p) {
  return scene.materials[scene.ground.at(p)].name;
}

Mesh mesh_of(const Scene& scene, const Building& building) {
  Mesh mesh{};
  const auto first = scene.buildings.mesh.vertices.begin() + building.first_vertex;
  mesh.vertices.assign(first, first + building.vertex_count);
  for (const auto& [a, b, c] : scene.buildings.mesh.triangles) {
    if (a < building.first_vertex || a >= building.first_vertex + building.vertex_count) continue;
    mesh.triangles.push_back({a - building.first_vertex, b - building.first_vertex, c - building.first_vertex});
  }
  return mesh;
}

/// The convex hull of a building's plan, counter-clockwise (Andrew's monotone chain).
Corners plan_of(const Scene& scene, const Building& building) {
  Corners points;
  for (std::uint32_t i = 0; i < building.vertex_count; ++i) {
    const Vec3f& v = scene.buildings.mesh.vertices[building.first_vertex + i];
    points.push_back({static_cast<double>(v.x), static_cast<double>(v.y)});
  }
  std::ranges::sort(points, [](Vec2d a, Vec2d b) { return a.x != b.x ? a.x < b.x : a.y < b.y; });
  Corners hull;
  for (int half = 0; half < 2; ++half) {
    const std::size_t start = hull.size();
    for (const Vec2d p : points) {
      while (hull.size() >= start + 2 && cross(hull.back() - hull[hull.size() - 2], p - hull.back()) <= 1e-9)
        hull.pop_back();
      hull.push_back(p);
    }
    hull.pop_back();
    std::ranges::reverse(points);
  }
  return hull;
}

std::vector<Corners> plans_of(const Scene& scene) {
  std::vector<Corners> plans;
  for (const Building& building : scene.buildings.items) plans.push_back(plan_of(scene, building));
  return plans;
}

/// How far a point lies outside a convex plan, negative inside; exact beside edges, too small past corners.
double outside_m(const Corners& plan, Vec2d p) {
  double outside = -std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < plan.size(); ++i) {
    const Vec2d edge = plan[(i + 1) % plan.size()] - plan[i];
    outside = std::max(outside, -cross(edge, p - plan[i]) / length(edge));
  }
  return outside;
}

bool an_edge_separates(const Corners& plan, const Corners& other) {
  for (std::size_t i = 0; i < plan.size(); ++i) {
    const Vec2d edge = plan[(i + 1) % plan.size()] - plan[i];
    if (std::ranges::all_of(other, [&](Vec2d p) { return cross(edge, p - plan[i]) < 0.0; })) return true;
  }
  return false;
}

std::set<std::string> ground_names(const Scene& scene) {
  std::set<std::string> names;
  std::vector<bool> seen(scene.materials.size());
  for (const MaterialIndex material : scene.ground.material.values()) seen[material] = true;
  for (std::size_t i = 0; i < seen.size(); ++i) {
    if (seen[i]) names.insert(scene.materials[i].name);
  }
  return names;
}

TEST(PaperSceneSize, KeepsThePapersSpacingsAndDensities) {
  const PaperSceneSize quarter = paper_scene_size(0.25);
  EXPECT_DOUBLE_EQ(quarter.side_m, 500.0);
  EXPECT_EQ(quarter.height_nodes, 129U);
  EXPECT_EQ(quarter.material_cells, 1024U);
  EXPECT_EQ(quarter.trees, 4433U);
  EXPECT_EQ(quarter.buildings, 130U);
  EXPECT_EQ(paper_scene_size(0.3).material_cells, 1024U);
}

TEST(PaperScene, FullScaleHasThePapersCounts) {
  const Scene scene = paper_scene();
  EXPECT_NEAR(scene.extent.width_m(), 2000.0, 1e-9);
  EXPECT_NEAR(scene.extent.height_m(), 2000.0, 1e-9);
  EXPECT_EQ(scene.terrain.height_m.columns(), 513U);
  EXPECT_EQ(scene.terrain.height_m.rows(), 513U);
  EXPECT_EQ(scene.ground.material.columns(), 4096U);
  EXPECT_EQ(scene.ground.material.rows(), 4096U);
  EXPECT_EQ(std::ranges::count_if(scene.instances, [&](const Instance& i) { return is_tree(scene, i); }), 70'928);
  EXPECT_EQ(scene.buildings.items.size(), 2082U);
  EXPECT_NEAR(static_cast<double>(scene.buildings.mesh.vertices.size()) / 2082.0, 30.0, 3.0);
}

TEST(PaperScene, ASeedIsAScene) {
  const std::string first = scene_hash(paper_scene({.scale = 0.25, .seed = 1}));
  EXPECT_EQ(first, scene_hash(paper_scene({.scale = 0.25, .seed = 1})));
  EXPECT_NE(first, scene_hash(paper_scene({.scale = 0.25, .seed = 2})));
}

TEST(PaperScene, RefusesScalesOutOfRange) {
  EXPECT_THROW((void)paper_scene({.scale = 0.0}), Error);
  EXPECT_THROW((void)paper_scene({.scale = 50.0}), Error);
  EXPECT_THROW((void)paper_scene({.scale = std::nan("")}), Error);
}

TEST(PaperScene, PaperPresetUsesThePapersSurfaces) {
  const Scene scene = paper_scene({.scale = 0.25});
  EXPECT_EQ(ground_names(scene), (std::set<std::string>{"bare_soil", "concrete", "forest_floor", "grass", "water"}));
  for (const MaterialIndex material : scene.buildings.mesh.materials)
    ASSERT_EQ(scene.materials[material].name, "paper_building");
  std::set<std::string> tree_names;
  for (const MaterialIndex material : scene.prototypes.front().materials)
    tree_names.insert(scene.materials[material].name);
  EXPECT_EQ(tree_names, (std::set<std::string>{"paper_bark", "paper_leaf"}));
}

/// What must hold of every landscape, with the materials that tell roads from yards.
struct Landscape {
  double scale;
  std::uint64_t seed;
};

class PaperLandscapeRules : public testing::TestWithParam<Landscape> {
 protected:
  Scene scene = paper_scene({.scale = GetParam().scale, .seed = GetParam().seed, .materials = PaperMaterials::Itu});
};

TEST_P(PaperLandscapeRules, HasItsCounts) {
  const PaperSceneSize size = paper_scene_size(GetParam().scale);
  EXPECT_EQ(scene.buildings.items.size(), size.buildings);
  EXPECT_EQ(std::ranges::count_if(scene.instances, [&](const Instance& i) { return is_tree(scene, i); }),
            static_cast<std::ptrdiff_t>(size.trees));
}

TEST_P(PaperLandscapeRules, HasEveryKindOfGround) {
  std::map<std::string, double> share;
  for (const MaterialIndex material : scene.ground.material.values()) {
    share[scene.materials[material].name] += 1.0 / static_cast<double>(scene.ground.material.size());
  }
  for (const char* name : {"concrete", "asphalt", "grass", "water", "bare_soil", "forest_floor"})
    EXPECT_GT(share[name], 0.01) << name;
}

TEST_P(PaperLandscapeRules, WaterIsLevelAndLowest) {
  const float lowest = scene.terrain.lowest_m();
  const auto water = std::ranges::find(scene.materials, "water", &scatter::Material::name) - scene.materials.begin();
  for (std::size_t row = 0; row < scene.ground.grid.rows; ++row) {
    for (std::size_t column = 0; column < scene.ground.grid.columns; ++column) {
      const Vec2d p = scene.ground.grid.centre_of(column, row);
      if (scene.ground.material(column, row) == water) {
        ASSERT_NEAR(scene.terrain.height_at(p), lowest, 1e-3) << p.x << ' ' << p.y;
      }
    }
  }
  EXPECT_GT(scene.terrain.highest_m() - lowest, 10.0F * static_cast<float>(GetParam().scale));
}

TEST_P(PaperLandscapeRules, BuildingsAreSolidAndStandApartInTheExtent) {
  const std::vector<Corners> plans = plans_of(scene);
  for (std::size_t i = 0; i < plans.size(); ++i) {
    for (const Vec2d corner : plans[i]) EXPECT_TRUE(scene.extent.contains(corner));
    for (std::size_t j = 0; j < i; ++j) {
      if (length(plans[i][0] - plans[j][0]) > 120.0) continue;
      EXPECT_TRUE(an_edge_separates(plans[i], plans[j]) || an_edge_separates(plans[j], plans[i])) << i << ' ' << j;
    }
  }
}

TEST_P(PaperLandscapeRules, BuildingsStandNeitherInWaterNorOnRoads) {
  for (const Corners& plan : plans_of(scene)) {
    for (std::size_t i = 0; i < plan.size(); ++i) {
      for (double share = 0.0; share < 1.0; share += 0.05) {
        const std::string& ground = ground_name(scene, plan[i] + (plan[(i + 1) % plan.size()] - plan[i]) * share);
        EXPECT_NE(ground, "water");
        EXPECT_NE(ground, "asphalt");
      }
    }
  }
}

TEST_P(PaperLandscapeRules, BuildingsFaceOutwardAndAreFootedAtTheLowestGroundAroundThem) {
  for (std::size_t i = 0; i < scene.buildings.items.size(); i += 7) {
    const Building& building = scene.buildings.items[i];
    EXPECT_GT(signed_volume_m3(mesh_of(scene, building)), 10.0);
    for (const Vec2d corner : plan_of(scene, building))
      EXPECT_LE(building.footing_m, scene.terrain.height_at(corner) + 0.05);
  }
}

TEST_P(PaperLandscapeRules, TreesStandOnSoftGroundAwayFromBuildings) {
  constexpr double bucket_m = 64.0;
  std::map<std::pair<int, int>, std::vector<Corners>> plans_near;
  const auto bucket = [](double x) { return static_cast<int>(std::floor(x / bucket_m)); };
  for (const Corners& plan : plans_of(scene)) {
    for (int dx = -1; dx <= 1; ++dx) {
      for (int dy = -1; dy <= 1; ++dy) plans_near[{bucket(plan[0].x) + dx, bucket(plan[0].y) + dy}].push_back(plan);
    }
  }
  const std::set<std::string> soft{"grass", "bare_soil", "forest_floor"};
  for (const Instance& instance : scene.instances) {
    if (!is_tree(scene, instance)) continue;
    const Vec2d p = place_of(instance);
    ASSERT_TRUE(scene.extent.contains(p));
    ASSERT_TRUE(soft.contains(ground_name(scene, p))) << ground_name(scene, p);
    for (const Corners& plan : plans_near[{bucket(p.x), bucket(p.y)}]) ASSERT_GT(outside_m(plan, p), 1.0);
  }
}

TEST_P(PaperLandscapeRules, VehiclesStandAndMoveOnPavement) {
  std::size_t moving = 0, parked = 0;
  for (const Instance& instance : scene.instances) {
    if (is_tree(scene, instance)) continue;
    const std::string& ground = ground_name(scene, place_of(instance));
    EXPECT_TRUE(ground == "asphalt" || ground == "concrete") << ground;
    if (instance.speed_mps > 0.0F) {
      EXPECT_EQ(ground, "asphalt");
    }
    (instance.speed_mps > 0.0F ? moving : parked) += 1;
  }
  EXPECT_GT(moving, 20U);
  EXPECT_GT(parked, 20U);
}

TEST_P(PaperLandscapeRules, OppositeLanesDriveOnTheRight) {
  // On the highway, which runs roughly from west to east, eastbound traffic keeps to the south.
  double east_y = 0.0, west_y = 0.0, east = 0.0, west = 0.0;
  for (const Instance& instance : scene.instances) {
    if (is_tree(scene, instance) || instance.speed_mps < 20.0F) continue;
    const double eastward = std::sin(static_cast<double>(instance.yaw_rad));
    (eastward > 0.0 ? east_y : west_y) += static_cast<double>(instance.y_m);
    (eastward > 0.0 ? east : west) += 1.0;
  }
  ASSERT_GT(east * west, 0.0);
  EXPECT_LT(east_y / east, west_y / west);
}

INSTANTIATE_TEST_SUITE_P(ScalesAndSeeds, PaperLandscapeRules,
                         testing::Values(Landscape{0.25, 1}, Landscape{0.25, 2}, Landscape{0.25, 3}, Landscape{0.15, 4},
                                         Landscape{0.4, 5}));

}  // namespace
}  // namespace sigmascape::scene
