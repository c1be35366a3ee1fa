#include "sigmascape/geo/polygon_overlay.h"

#include <cmath>
#include <gtest/gtest.h>

namespace sigmascape::geo {
namespace {

Polygon box(double west, double south, double east, double north) {
  return {{{west, south}, {east, south}, {east, north}, {west, north}}, {}};
}

TEST(PolygonOverlay, ValidPolygonStaysAsItIs) {
  const auto result = repaired(box(0, 0, 4, 3));
  EXPECT_TRUE(result.was_valid);
  EXPECT_DOUBLE_EQ(area_m2(result.polygons), 12.0);
}

TEST(PolygonOverlay, BowTieBecomesItsTwoTriangles) {
  const auto result = repaired({{{0, 0}, {10, 10}, {10, 0}, {0, 10}}, {}});
  EXPECT_FALSE(result.was_valid);
  EXPECT_EQ(result.polygons.size(), 2U);
  EXPECT_NEAR(area_m2(result.polygons), 50.0, 1e-6);
}

TEST(PolygonOverlay, RingsRunSoThatTheAreaLiesLeft) {
  const auto result = subtracted({box(0, 0, 10, 10)}, {box(4, 4, 6, 6)});
  ASSERT_EQ(result.size(), 1U);
  ASSERT_EQ(result[0].holes.size(), 1U);
  EXPECT_NEAR(signed_area_m2(result[0].outer), 100.0, 1e-9);
  EXPECT_NEAR(signed_area_m2(result[0].holes[0]), -4.0, 1e-9);
}

TEST(PolygonOverlay, CutUniteAndIntersectKeepArea) {
  const Polygons a{box(0, 0, 10, 10)}, b{box(5, 5, 15, 15)};
  EXPECT_NEAR(area_m2(subtracted(a, b)), 75.0, 1e-6);
  EXPECT_NEAR(area_m2(united(a, b)), 175.0, 1e-6);
  EXPECT_NEAR(area_m2(intersected(a, b)), 25.0, 1e-6);
  EXPECT_TRUE(intersected(a, {box(20, 20, 30, 30)}).empty());
}

TEST(PolygonOverlay, TrianglesFillAPolygonWithHolesAndLeaveTheHolesOpen) {
  Polygon yard = box(0, 0, 20, 10);
  yard.holes = {{{2, 2}, {2, 8}, {8, 8}, {8, 2}}, {{12, 3}, {12, 7}, {17, 7}, {17, 3}}};
  double area = 0.0;
  for (const auto& [a, b, c] : triangulated(yard)) {
    const double twice = cross(b - a, c - a);
    EXPECT_GT(twice, 0.0);
    area += twice / 2.0;
    const Vec2d middle = (a + b + c) * (1.0 / 3.0);
    EXPECT_FALSE(middle.x > 2 && middle.x < 8 && middle.y > 2 && middle.y < 8);
    EXPECT_FALSE(middle.x > 12 && middle.x < 17 && middle.y > 3 && middle.y < 7);
  }
  EXPECT_NEAR(area, 200.0 - 36.0 - 20.0, 1e-9);
}

TEST(PolygonOverlay, SimplifyingDropsCornersOnAStraightEdge) {
  const auto result = simplified({{{{0, 0}, {3, 0.001}, {6, 0}, {6, 5}, {0, 5}}, {}}}, 0.05);
  ASSERT_EQ(result.size(), 1U);
  EXPECT_EQ(result[0].outer.size(), 4U);
}

TEST(PolygonOverlay, LineHasNoArea) {
  EXPECT_TRUE(repaired({{{0, 0}, {5, 5}, {0, 0}}, {}}).polygons.empty());
}

}  // namespace
}  // namespace sigmascape::geo
