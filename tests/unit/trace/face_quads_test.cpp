#include "sigmascape/trace/face_quads.h"

#include <cmath>
#include <gtest/gtest.h>

#include "plain_scene.h"

#include "sigmascape/scene/solid_mesh.h"
#include "sigmascape/trace/scene_geometry.h"

namespace sigmascape::trace {
namespace {

Vec3f doubled_area(const scene::Mesh& mesh, std::uint32_t a, std::uint32_t b, std::uint32_t c) {
  return cross(mesh.vertices[b] - mesh.vertices[a], mesh.vertices[c] - mesh.vertices[a]);
}

/// Sum over a mesh of the areas of its quads, each as the two triangles that it stands for.
float area_m2(const scene::Mesh& mesh, const FaceQuads& quads) {
  float doubled = 0.0F;
  for (const auto& [a, b, c, d] : quads.corners)
    doubled += length(doubled_area(mesh, a, b, d)) + length(doubled_area(mesh, c, d, b));
  return 0.5F * doubled;
}

TEST(FaceQuads, SidesOfABoxAreOneQuadEach) {
  const scene::Mesh box = scene::box_mesh({2, 3, 5}, 7);
  const FaceQuads quads = face_quads(box);
  ASSERT_EQ(quads.corners.size(), 6U);
  ASSERT_EQ(quads.traits.size(), 6U);
  EXPECT_NEAR(area_m2(box, quads), 62.0F, 1e-4F);
  for (std::size_t i = 0; i < 6; ++i) {
    const auto& [a, b, c, d] = quads.corners[i];
    const Vec3f one = doubled_area(box, a, b, d), other = doubled_area(box, c, d, b);
    EXPECT_NEAR(length(one - other), 0.0F, 1e-5F) << "both halves of side " << i << " face one way";
    EXPECT_NEAR(quads.traits[i].inverse_area_per_m2, 1.0F / length(one), 1e-6F);
    EXPECT_EQ(quads.traits[i].material, 7);
  }
}

TEST(FaceQuads, FacesOfOtherMaterialsOrPlanesStayApart) {
  scene::Mesh box = scene::box_mesh({2, 2, 2}, 0);
  for (std::size_t i = 0; i < box.materials.size(); ++i) box.materials[i] = static_cast<scene::MaterialIndex>(i % 2);
  EXPECT_EQ(face_quads(box).corners.size(), 12U);
  EXPECT_NEAR(area_m2(box, face_quads(box)), 24.0F, 1e-5F);

  const scene::Mesh roof{.name = "roof",
                         .vertices = {{0, 0, 0}, {4, 0, 0}, {4, 1, 2}, {0, 1, 2}, {4, 3, 0}},
                         .triangles = {{0, 1, 2}, {0, 2, 3}, {3, 2, 4}},
                         .materials = {1, 1, 1}};
  const FaceQuads quads = face_quads(roof);
  ASSERT_EQ(quads.corners.size(), 2U);
  EXPECT_EQ(quads.corners[1], (std::array<std::uint32_t, 4>{3, 2, 4, 4}));
  EXPECT_NE(quads.traits[0].inverse_area_per_m2, quads.traits[1].inverse_area_per_m2);
}

// An odd number of triangles to a face, each of them met where it is, from both sides.
TEST(FaceQuads, EveryPartOfAFaceIsMet) {
  scene::Scene scene = plain_scene();
  constexpr std::uint32_t sides = 9;
  constexpr float half_side = static_cast<float>(pi) / static_cast<float>(sides);
  scene.prototypes.push_back(scene::cylinder_mesh(4.0F, 6.0F, sides, 0));
  scene.instances.push_back({.prototype = 0});
  ASSERT_EQ(face_quads(scene.prototypes[0]).corners.size(), sides + 2 * ((sides - 2 + 1) / 2));
  for (const Footing footing : {Footing::LevelPlane, Footing::Terrain}) {
    const SceneGeometry geometry(scene, footing);
    for (int i = 0; i < 360; ++i) {
      const float angle = static_cast<float>(i) * 0.0174533F + 0.001F, z = 0.1F + 0.016F * static_cast<float>(i);
      const Vec3f out{std::cos(angle), std::sin(angle), 0.0F};
      SurfaceHit side, roof;
      ASSERT_TRUE(geometry.intersect(out * 20.0F + Vec3f{0, 0, z}, -out, side)) << i;
      const float from_middle = std::fmod(angle, 2.0F * half_side) - half_side;
      EXPECT_NEAR(dot(side.position, out), 4.0F * std::cos(half_side) / std::cos(from_middle), 1e-4F) << i;
      ASSERT_TRUE(geometry.intersect(out * 3.5F + Vec3f{0, 0, 30.0F}, {0, 0, -1}, roof)) << i;
      EXPECT_NEAR(roof.position.z, 6.0F, 1e-4F) << i;
      EXPECT_TRUE(geometry.occluded(out * 3.5F + Vec3f{0, 0, 3.0F}, {0, 0, 1})) << i;
    }
  }
}

}  // namespace
}  // namespace sigmascape::trace
