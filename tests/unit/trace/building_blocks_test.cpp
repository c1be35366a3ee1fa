#include "sigmascape/trace/building_blocks.h"

#include <gtest/gtest.h>
#include <utility>

#include "plain_scene.h"

#include "sigmascape/trace/scene_geometry.h"

namespace sigmascape::trace {
namespace {

constexpr int side = 9;
constexpr float street_m = 20.0F;

Vec2f place_of(int i) {
  return {street_m * static_cast<float>(i % side - side / 2), street_m * static_cast<float>(i / side - side / 2)};
}
float height_of(int i) {
  return 3.0F + static_cast<float>(i);
}

/// Houses of 8 m by 6 m in rows, no two equally high, of two materials; each a building unless told otherwise.
scene::Scene town(bool has_items = true) {
  scene::Scene scene = plain_scene();
  const scene::MaterialIndex brick = scene.material_index(lambert("brick", 0.3));
  const scene::MaterialIndex glass = scene.material_index(lambert("glass", 0.1));
  scene::Mesh& all = scene.buildings.mesh;
  for (int i = 0; i < side * side; ++i) {
    const scene::Mesh house = scene::box_mesh({8.0F, 6.0F, height_of(i)}, i % 2 == 0 ? brick : glass);
    const auto first = static_cast<std::uint32_t>(all.vertices.size());
    const auto [x, y] = place_of(i);
    for (const Vec3f& v : house.vertices) all.vertices.push_back({v.x + x, v.y + y, v.z});
    for (const auto& [a, b, c] : house.triangles) all.triangles.push_back({first + a, first + b, first + c});
    all.materials.insert(all.materials.end(), house.materials.begin(), house.materials.end());
    if (has_items) scene.buildings.items.push_back({first, static_cast<std::uint32_t>(house.vertices.size()), 0.0F});
  }
  return scene;
}

TEST(BuildingBlocks, EveryFaceIsInOneBlockAndNoBuildingInTwo) {
  const scene::Scene scene = town();
  const auto& mesh = scene.buildings.mesh;
  const BuildingBlocks squares = building_blocks(scene.buildings, mesh.vertices);
  EXPECT_GT(squares.blocks.size(), 9U);
  std::size_t faces = 0, vertices = 0;
  for (const BuildingBlock& block : squares.blocks) {
    EXPECT_EQ(block.first_face, faces);
    faces += block.corners.size();
    vertices += block.vertices.size();
    EXPECT_EQ(block.corners.size() % 6, 0U) << "whole boxes";
  }
  EXPECT_EQ(faces, 6U * side * side);
  EXPECT_EQ(squares.traits.size(), faces);
  EXPECT_EQ(vertices, mesh.vertices.size()) << "none is kept twice";
}

// A row of houses of one height on a hill, wall to wall: each roof ends at the next step.
TEST(BuildingBlocks, RoofsOnOtherFootingsAreFacesOfTheirOwn) {
  scene::Scene scene = plain_scene();
  const scene::MaterialIndex brick = scene.material_index(lambert("brick", 0.3));
  scene::Mesh& all = scene.buildings.mesh;
  for (int i = 0; i < 3; ++i) {
    const scene::Mesh house = scene::box_mesh({10.0F, 10.0F, 8.0F}, brick);
    const auto first = static_cast<std::uint32_t>(all.vertices.size());
    for (const Vec3f& v : house.vertices) all.vertices.push_back({v.x + 10.0F * static_cast<float>(i), v.y, v.z});
    for (const auto& [a, b, c] : house.triangles) all.triangles.push_back({first + a, first + b, first + c});
    all.materials.insert(all.materials.end(), house.materials.begin(), house.materials.end());
    scene.buildings.items.push_back(
        {first, static_cast<std::uint32_t>(house.vertices.size()), 3.0F * static_cast<float>(i)});
  }
  for (const auto& [footing, area_m2] : {std::pair(Footing::Terrain, 100.0F), {Footing::LevelPlane, 300.0F}}) {
    const SceneGeometry geometry(scene, footing);
    SurfaceHit hit;
    ASSERT_TRUE(geometry.intersect({11.0F, 2.0F, 200.0F}, {0, 0, -1}, hit));
    EXPECT_NEAR(hit.inverse_facet_area_per_m2 * area_m2, 1.0F, 1e-4F);
  }
}

TEST(BuildingBlocks, EveryHouseStandsWhereItStood) {
  for (const bool has_items : {true, false}) {
    const scene::Scene scene = town(has_items);
    for (const Footing footing : {Footing::LevelPlane, Footing::Terrain}) {
      const SceneGeometry geometry(scene, footing);
      for (int i = 0; i < side * side; ++i) {
        const auto [x, y] = place_of(i);
        const scene::MaterialIndex material = i % 2 == 0 ? 1 : 2;
        SurfaceHit hit;
        ASSERT_TRUE(geometry.intersect({x + 1.0F, y - 2.0F, 200.0F}, {0, 0, -1}, hit));
        EXPECT_NEAR(hit.position.z, height_of(i), 1e-4F);
        EXPECT_EQ(hit.material, material);
        EXPECT_NEAR(hit.inverse_facet_area_per_m2, 1.0F / 48.0F, 1e-6F);
        ASSERT_TRUE(geometry.intersect({x + 9.0F, y + 1.0F, 2.0F}, {-1, 0, 0}, hit));
        EXPECT_NEAR(hit.position.x, x + 4.0F, 1e-4F);
        EXPECT_NEAR(hit.normal.x, 1.0F, 1e-6F);
        EXPECT_EQ(hit.material, material);
        EXPECT_NEAR(hit.inverse_facet_area_per_m2, 1.0F / (6.0F * height_of(i)), 1e-6F);
        EXPECT_FALSE(geometry.intersect({x + 9.0F, y + 1.0F, 2.0F}, {0, 0, 1}, hit));
      }
    }
  }
}

}  // namespace
}  // namespace sigmascape::trace
