#include "results/vertices.h"

#include <gtest/gtest.h>

namespace sigmascape::cli {
namespace {

TEST(ResultsVertices, AreThoseWithinTheExtent) {
  scene::Scene scene;
  scene.extent = {0.0, 0.0, 10.0, 10.0};
  // Nodes every 5 m, at -10 … 15 m both ways: three a side within.
  scene.terrain = {.west_m = -10.0, .north_m = 15.0, .spacing_m = 5.0, .height_m = Array2D<float>(6, 6)};
  scene.buildings.mesh.vertices = {{1.0F, 1.0F, 3.0F}, {9.0F, 9.0F, 3.0F}, {11.0F, 5.0F, 3.0F}};
  scene.prototypes.resize(1);
  scene.prototypes[0].vertices.resize(7);
  scene.instances.resize(2);
  scene.instances[0].x_m = scene.instances[0].y_m = 5.0F;
  scene.instances[1].x_m = -5.0F;
  const VertexCounts counts = vertices_within_extent(scene);
  EXPECT_EQ(counts.terrain, 9U);
  EXPECT_EQ(counts.objects, 2U + 7U);
}

TEST(ResultsVertices, OfTerrainAreNoMoreThanItHas) {
  scene::Scene scene;
  scene.extent = {-100.0, -100.0, 100.0, 100.0};
  scene.terrain = {.west_m = 0.0, .north_m = 0.0, .spacing_m = 1.0, .height_m = Array2D<float>(4, 3)};
  EXPECT_EQ(vertices_within_extent(scene).terrain, 12U);
}

}  // namespace
}  // namespace sigmascape::cli
