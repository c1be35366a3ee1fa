#include "sigmascape/scene/solid_mesh.h"

#include <cmath>
#include <gtest/gtest.h>

#include "closed_mesh.h"

#include "sigmascape/base/units.h"

namespace sigmascape::scene {
namespace {

Vec3f normal_of(const Mesh& mesh, std::size_t triangle) {
  const auto [a, b, c] = mesh.triangles[triangle];
  return normalized(cross(mesh.vertices[b] - mesh.vertices[a], mesh.vertices[c] - mesh.vertices[a]));
}

TEST(SolidMesh, BoxHasItsVolumeWithNormalsOutward) {
  const Mesh box = box_mesh({2.0F, 3.0F, 5.0F}, 4);
  EXPECT_NEAR(signed_volume_m3(box), 30.0, 1e-5);
  EXPECT_TRUE(is_closed(box));
  ASSERT_EQ(box.materials.size(), box.triangles.size());
  EXPECT_EQ(box.materials.front(), 4);
}

TEST(SolidMesh, VolumeDoesNotDependOnThePlaceAndTurnsWithTheFacets) {
  Mesh moved{};
  append_mesh(moved, box_mesh({2.0F, 3.0F, 5.0F}, 0), {10.0F, -7.0F, 3.0F});
  EXPECT_NEAR(signed_volume_m3(moved), 30.0, 1e-3);
  for (auto& triangle : moved.triangles) std::swap(triangle[1], triangle[2]);
  EXPECT_NEAR(signed_volume_m3(moved), -30.0, 1e-3);
}

TEST(SolidMesh, CylinderHasTheVolumeOfItsPolygon) {
  constexpr unsigned sides = 24;
  const Mesh cylinder = cylinder_mesh(2.0F, 5.0F, sides, 0);
  EXPECT_NEAR(signed_volume_m3(cylinder), 0.5 * sides * 4.0 * std::sin(2.0 * pi / sides) * 5.0, 1e-3);
  EXPECT_TRUE(is_closed(cylinder));
}

TEST(SolidMesh, CylinderSidesFaceAwayFromItsAxis) {
  const Mesh cylinder = cylinder_mesh(2.0F, 5.0F, 24, 0);
  for (std::size_t i = 0; i < cylinder.triangles.size(); ++i) {
    const Vec3f normal = normal_of(cylinder, i);
    if (std::abs(normal.z) > 0.5F) continue;
    const Vec3f on_side = cylinder.vertices[cylinder.triangles[i][0]];
    EXPECT_GT(normal.x * on_side.x + normal.y * on_side.y, 0.0F);
    EXPECT_NEAR(normal.z, 0.0F, 1e-6F);
  }
}

TEST(SolidMesh, WallFacesSouth) {
  const Mesh wall = wall_mesh(6.0F, 4.0F, 0);
  ASSERT_EQ(wall.triangles.size(), 2U);
  for (std::size_t i = 0; i < 2; ++i) EXPECT_NEAR(normal_of(wall, i).y, -1.0F, 1e-6F);
  EXPECT_FALSE(is_closed(wall));
}

TEST(SolidMesh, PrismOnAnLShapedOutlineIsClosed) {
  const Vec2f outline[] = {{1, 1}, {1, 2}, {0, 2}, {0, 0}, {2, 0}, {2, 1}};
  Mesh prism{};
  append_prism(prism, outline, 1.0F, 3.0F, 0);
  EXPECT_TRUE(is_closed(prism));
  EXPECT_NEAR(signed_volume_m3(prism), 6.0, 1e-5);
}

}  // namespace
}  // namespace sigmascape::scene
