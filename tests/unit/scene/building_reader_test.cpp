#include <algorithm>
#include <array>
#include <cstddef>
#include <gtest/gtest.h>
#include <vector>

#include "sigmascape/scene/building_extrusion.h"
#include "sigmascape/scene/footprint.h"

namespace sigmascape::scene {
namespace {

geo::Polygon box(double west, double south, double east, double north) {
  return {{{west, south}, {east, south}, {east, north}, {west, north}}, {}};
}

Footprint footprint(geo::Polygon outline, double height_m) {
  Footprint result;
  result.shape = {std::move(outline)};
  result.height_m = height_m;
  result.id = "feature";
  return result;
}

double total_area_m2(const std::vector<Footprint>& footprints) {
  double sum = 0.0;
  for (const Footprint& one : footprints) sum += geo::area_m2(one.shape);
  return sum;
}

std::vector<Remark> remarks_of(const FlawTally& tally) {
  std::vector<Remark> remarks;
  tally.settle("file", 10, {}, remarks);
  return remarks;
}

TEST(WithoutOverlaps, CutsTheLowerByTheTaller) {
  std::array<FlawTally, 1> tally;
  const auto result = without_overlaps({footprint(box(0, 0, 10, 10), 5.0), footprint(box(5, 0, 15, 10), 20.0)}, tally);
  ASSERT_EQ(result.size(), 2U);
  EXPECT_NEAR(geo::area_m2(result[0].shape), 50.0, 1e-6);
  EXPECT_NEAR(geo::area_m2(result[1].shape), 100.0, 1e-6);
  EXPECT_NEAR(total_area_m2(result), 150.0, 1e-6);
  EXPECT_EQ(remarks_of(tally[0])[0].count, 1U);
}

TEST(WithoutOverlaps, MergesEqualHeightsIntoOne) {
  std::array<FlawTally, 1> tally;
  const auto result = without_overlaps({footprint(box(0, 0, 10, 10), 8.0), footprint(box(5, 0, 15, 10), 8.0)}, tally);
  ASSERT_EQ(result.size(), 1U);
  EXPECT_NEAR(total_area_m2(result), 150.0, 1e-6);
}

TEST(WithoutOverlaps, LowerBuildingInsideATallerOneVanishes) {
  std::array<FlawTally, 1> tally;
  const auto result = without_overlaps({footprint(box(2, 2, 4, 4), 3.0), footprint(box(0, 0, 10, 10), 9.0)}, tally);
  ASSERT_EQ(result.size(), 1U);
  EXPECT_EQ(result[0].height_m, 9.0);
}

TEST(WithoutOverlaps, TallerBuildingInsideALowerOneLeavesAHole) {
  std::array<FlawTally, 1> tally;
  const auto result = without_overlaps({footprint(box(0, 0, 10, 10), 3.0), footprint(box(4, 4, 6, 6), 9.0)}, tally);
  ASSERT_EQ(result.size(), 2U);
  EXPECT_EQ(result[0].shape[0].holes.size(), 1U);
  EXPECT_NEAR(total_area_m2(result), 100.0, 1e-6);
}

// Two blocks of one feature, the first in two pieces about a tower.
TEST(WithoutOverlaps, PiecesKnowTheWholeThatTheyWereCutFrom) {
  std::array<FlawTally, 1> tally;
  Footprint blocks = footprint(box(0, 0, 30, 10), 5.0);
  blocks.shape.push_back(box(100, 0, 110, 10));
  const auto result = without_overlaps({blocks, footprint(box(10, -5, 20, 15), 9.0)}, tally);
  ASSERT_EQ(result.size(), 2U);
  ASSERT_EQ(result[0].shape.size(), 3U);
  for (std::size_t i = 0; i < 3; ++i) {
    const geo::Polygon& piece = result[0].shape[i];
    EXPECT_NEAR(geo::area_m2(piece), 100.0, 1e-6);
    EXPECT_NEAR(geo::area_m2(whole_of(i, result[0])), piece.outer.front().x < 50.0 ? 300.0 : 100.0, 1e-6);
  }
  EXPECT_EQ(&whole_of(0, result[1]), &result[1].shape[0]) << "nothing cut it";
}

// A row of equal houses, each across the next.
TEST(WithoutOverlaps, ManyThatBelongTogetherBecomeOne) {
  std::array<FlawTally, 1> tally;
  std::vector<Footprint> row;
  for (int i = 0; i < 40; ++i) row.push_back(footprint(box(8.0 * i, 0, 8.0 * i + 10.0, 10), 8.0));
  const auto result = without_overlaps(row, tally);
  ASSERT_EQ(result.size(), 1U);
  EXPECT_EQ(result[0].shape.size(), 1U);
  EXPECT_NEAR(total_area_m2(result), (39 * 8.0 + 10.0) * 10.0, 1e-6);
  std::vector<Remark> remarks;
  tally[0].settle("file", row.size(), {.max_share = 1.0}, remarks);
  EXPECT_EQ(remarks.at(0).count, 39U);
}

TEST(WithoutOverlaps, NeighboursWallToWallStayTwo) {
  std::array<FlawTally, 1> tally;
  const auto result = without_overlaps({footprint(box(0, 0, 10, 10), 8.0), footprint(box(10, 0, 20, 10), 8.0)}, tally);
  EXPECT_EQ(result.size(), 2U);
  EXPECT_TRUE(remarks_of(tally[0]).empty());
}

/// Six times the volume enclosed by triangles: exact only when all faces look outward and nothing but the floor is
/// open.
double enclosed_volume_m3(const Mesh& mesh) {
  double six = 0.0;
  for (const auto& t : mesh.triangles) {
    six += dot(mesh.vertices[t[0]].to<double>(),
               cross(mesh.vertices[t[1]].to<double>(), mesh.vertices[t[2]].to<double>()));
  }
  return six / 6.0;
}

TEST(BuildingExtrusion, WallsAndRoofFaceOutwardAndCourtyardsStayOpen) {
  geo::Polygon yard = box(0, 0, 20, 10);
  yard.holes = {{{5, 3}, {5, 7}, {15, 7}, {15, 3}}};
  Buildings buildings;
  append_building(buildings, yard, 6.0, 3.0, 1, 2);
  // The floor lies in z = 0 and adds nothing to the sum.
  EXPECT_NEAR(enclosed_volume_m3(buildings.mesh), (200.0 - 40.0) * 6.0, 1e-3);
  EXPECT_EQ(buildings.mesh.vertices.size(), 16U);
  EXPECT_EQ(buildings.items.at(0).footing_m, 3.0F);
  EXPECT_EQ(std::ranges::count(buildings.mesh.materials, MaterialIndex{1}), 16);
}

TEST(BuildingExtrusion, ACourtyardAtTheOutlineLeavesTheRoofWhole) {
  geo::Polygon yard = box(0, 0, 10, 10);
  yard.holes = {{{5, 0}, {3, 4}, {7, 4}}};
  Buildings buildings;
  append_building(buildings, yard, 6.0, 3.0, 1, 2);
  EXPECT_NEAR(enclosed_volume_m3(buildings.mesh), (100.0 - 8.0) * 6.0, 1e-3);
}

TEST(BuildingExtrusion, TheFootingIsTheLowestGroundAlongTheOutline) {
  terrain::HeightField slope{0.0, 100.0, 10.0, Array2D<float>(11, 11)};
  for (std::size_t row = 0; row < 11; ++row) {
    for (std::size_t column = 0; column < 11; ++column) slope.height_m(column, row) = static_cast<float>(column);
  }
  EXPECT_NEAR(footing_of(box(30, 30, 60, 60), slope), 3.0, 1e-5);
}

}  // namespace
}  // namespace sigmascape::scene
