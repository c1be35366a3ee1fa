#include "sigmascape/scene/roofed_building.h"

#include <cmath>
#include <gtest/gtest.h>

#include "closed_mesh.h"

#include "sigmascape/scene/solid_mesh.h"

namespace sigmascape::scene {
namespace {

constexpr double length_m = 12.0, depth_m = 8.0, eaves_m = 5.0, rise_m = 3.0;

Buildings built(RoofForm roof) {
  Buildings buildings;
  append_roofed_building(buildings,
                         {.along = {1.0, 0.0},
                          .length_m = length_m,
                          .depth_m = depth_m,
                          .eaves_m = eaves_m,
                          .roof_rise_m = rise_m,
                          .roof = roof},
                         7.5);
  return buildings;
}

TEST(RoofedBuilding, VolumesAreThoseOfTheSolids) {
  const double box = length_m * depth_m * eaves_m;
  EXPECT_NEAR(signed_volume_m3(built(RoofForm::Flat).mesh), box, 1e-2);
  EXPECT_NEAR(signed_volume_m3(built(RoofForm::Gabled).mesh), box + length_m * depth_m * rise_m / 2.0, 1e-2);
  // A hipped roof is a wedge with a ridge of length − depth, here, where all slopes are alike.
  EXPECT_NEAR(signed_volume_m3(built(RoofForm::Hipped).mesh),
              box + depth_m * rise_m / 6.0 * (2.0 * length_m + length_m - depth_m), 1e-2);
  EXPECT_NEAR(signed_volume_m3(built(RoofForm::FlatLShaped).mesh), box * (1.0 - 0.45 * 0.5), 1e-2);
}

TEST(RoofedBuilding, ShellsAreClosed) {
  for (const RoofForm roof : {RoofForm::Flat, RoofForm::Gabled, RoofForm::Hipped, RoofForm::FlatLShaped}) {
    EXPECT_TRUE(is_closed(built(roof).mesh)) << static_cast<int>(roof);
  }
}

TEST(RoofedBuilding, VertexCountsAreThoseOfSeparateFacets) {
  EXPECT_EQ(built(RoofForm::Flat).mesh.vertices.size(), 24U);
  EXPECT_EQ(built(RoofForm::Gabled).mesh.vertices.size(), 30U);
}

TEST(RoofedBuilding, WallsReachTheFootingAndNothingGoesBelow) {
  const Buildings buildings = built(RoofForm::Gabled);
  ASSERT_EQ(buildings.items.size(), 1U);
  EXPECT_EQ(buildings.items[0].vertex_count, buildings.mesh.vertices.size());
  EXPECT_FLOAT_EQ(buildings.items[0].footing_m, 7.5F);
  float lowest = 1.0F, highest = 0.0F;
  for (const Vec3f& vertex : buildings.mesh.vertices) {
    lowest = std::min(lowest, vertex.z);
    highest = std::max(highest, vertex.z);
  }
  EXPECT_FLOAT_EQ(lowest, 0.0F);
  EXPECT_FLOAT_EQ(highest, static_cast<float>(eaves_m + rise_m));
}

TEST(RoofedBuilding, FootingIsTheLowestCornerOnASlope) {
  terrain::HeightField slope{.west_m = -50.0, .north_m = 50.0, .spacing_m = 100.0, .height_m = Array2D<float>(2, 2)};
  slope.height_m(0, 0) = slope.height_m(0, 1) = 0.0F;
  slope.height_m(1, 0) = slope.height_m(1, 1) = 10.0F;
  EXPECT_NEAR(footing_m(slope, {.centre = {0.0, 0.0}, .length_m = 20.0, .depth_m = 6.0}), 4.0, 1e-9);
}

}  // namespace
}  // namespace sigmascape::scene
