#include "sigmascape/scene/tree_mesh.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

namespace sigmascape::scene {
namespace {

constexpr MaterialIndex bark = 1, leaf = 2;

class TreeMesh : public testing::TestWithParam<TreeForm> {
 protected:
  Mesh tree = tree_mesh(GetParam(), {.bark = bark, .leaf = leaf}, 5);
};

TEST_P(TreeMesh, HasThePapersVertexCount) {
  EXPECT_EQ(tree.vertices.size(), 2257U);
}

TEST_P(TreeMesh, TrianglesAreWholeAndHaveMaterials) {
  ASSERT_EQ(tree.materials.size(), tree.triangles.size());
  EXPECT_EQ(std::ranges::count(tree.materials, leaf), 1000);
  for (const auto& [a, b, c] : tree.triangles) {
    ASSERT_LT(std::max({a, b, c}), tree.vertices.size());
    EXPECT_GT(length(cross(tree.vertices[b] - tree.vertices[a], tree.vertices[c] - tree.vertices[a])), 0.0F);
  }
}

TEST_P(TreeMesh, StandsOnTheGroundWithItsNominalSize) {
  float lowest = 1e9F, highest = 0.0F, widest = 0.0F;
  for (const Vec3f& vertex : tree.vertices) {
    lowest = std::min(lowest, vertex.z);
    highest = std::max(highest, vertex.z);
    widest = std::max(widest, std::hypot(vertex.x, vertex.y));
  }
  EXPECT_NEAR(lowest, 0.0F, 0.05F);
  EXPECT_NEAR(highest, tree_height_m, 1e-4F);
  EXPECT_NEAR(widest, tree_crown_radius_m, 1e-4F);
}

TEST_P(TreeMesh, CrownIsAboveAClearTrunk) {
  for (std::size_t i = 0; i < tree.triangles.size(); ++i) {
    if (tree.materials[i] == leaf) {
      EXPECT_GT(tree.vertices[tree.triangles[i][0]].z, 0.4F);
    }
  }
}

TEST_P(TreeMesh, TrunkNormalsPointOutward) {
  for (std::size_t i = 0; i < 16; ++i) {
    const auto [a, b, c] = tree.triangles[i];
    const Vec3f normal = cross(tree.vertices[b] - tree.vertices[a], tree.vertices[c] - tree.vertices[a]);
    EXPECT_GT(normal.x * tree.vertices[a].x + normal.y * tree.vertices[a].y, 0.0F);
  }
}

TEST_P(TreeMesh, SeedsDecideTheArrangement) {
  EXPECT_EQ(tree.vertices, tree_mesh(GetParam(), {.bark = bark, .leaf = leaf}, 5).vertices);
  EXPECT_NE(tree.vertices, tree_mesh(GetParam(), {.bark = bark, .leaf = leaf}, 6).vertices);
}

INSTANTIATE_TEST_SUITE_P(Forms, TreeMesh, testing::Values(TreeForm::Broadleaf, TreeForm::Conifer));

TEST(TreeScale, MakesATreeAsTallAndWideAsWanted) {
  const Vec3f scale = tree_scale(15.6F, 1.45F);
  EXPECT_FLOAT_EQ(scale.z, 2.0F);
  EXPECT_FLOAT_EQ(scale.x, 0.5F);
  EXPECT_FLOAT_EQ(scale.y, 0.5F);
}

}  // namespace
}  // namespace sigmascape::scene
