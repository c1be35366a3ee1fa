#include "sigmascape/geo/polygon_overlay.h"

#include <cmath>
#include <gtest/gtest.h>

#include "sigmascape/base/error.h"

namespace sigmascape::geo {
namespace {

Polygon box(double west, double south, double east, double north) {
  return {{{west, south}, {east, south}, {east, north}, {west, north}}, {}};
}

TEST(PolygonOverlay, ValidPolygonStaysAsItIs) {
  const auto result = repaired(box(0, 0, 4, 3));
  EXPECT_EQ(result.were, Rings::Valid);
  EXPECT_DOUBLE_EQ(area_m2(result.polygons), 12.0);
}

TEST(PolygonOverlay, BowTieBecomesItsTwoTriangles) {
  const auto result = repaired({{{0, 0}, {10, 10}, {10, 0}, {0, 10}}, {}});
  EXPECT_EQ(result.were, Rings::Cross);
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

TEST(PolygonOverlay, SimplifyingDropsCornersOnAStraightEdge) {
  const auto result = simplified({{{{0, 0}, {3, 0.001}, {6, 0}, {6, 5}, {0, 5}}, {}}}, 0.05);
  ASSERT_EQ(result.size(), 1U);
  EXPECT_EQ(result[0].outer.size(), 4U);
}

// Half of the square without its corner in the south-east, and a courtyard in what goes with that corner.
TEST(PolygonOverlay, SimplifyingMakesNoRingsCross) {
  const Polygon yard{{{7, 0}, {10, 0}, {10, 10}, {0, 10}, {0, 0}}, {{{7, 0}, {8, 2}, {9, 1}}}};
  const Polygon far = box(20, 0, 30, 10);
  for (const Polygons& shape : {Polygons{yard}, Polygons{far, yard}}) {
    const auto result = simplified(shape, 3.0);
    ASSERT_EQ(result.size(), shape.size());
    for (const Polygon& polygon : result) EXPECT_EQ(repaired(polygon).were, Rings::Valid);
    EXPECT_NEAR(area_m2(result), area_m2(shape), 1e-9);
  }
}

TEST(PolygonOverlay, CourtyardsAgainstTheOutlineTouchAndDoNotCross) {
  const Ring against_the_west{{0, 4}, {4, 4}, {4, 6}, {0, 6}}, through_the_west{{-1, 4}, {4, 4}, {4, 6}, {-1, 6}};
  const auto touching = repaired({box(0, 0, 10, 10).outer, {against_the_west}});
  EXPECT_EQ(touching.were, Rings::Touch);
  EXPECT_NEAR(area_m2(touching.polygons), 92.0, 1e-6);
  EXPECT_EQ(repaired({box(0, 0, 10, 10).outer, {through_the_west}}).were, Rings::Cross);
  // Two lobes of 100 and 50 m².
  const auto lobes = repaired({{{0, 0}, {30, 30}, {30, 40}, {10, 0}}, {}});
  EXPECT_EQ(lobes.were, Rings::Cross);
  EXPECT_NEAR(area_m2(lobes.polygons), 150.0, 1e-6);
}

TEST(PolygonOverlay, CourtyardsOfNoCornersAreNoneOfACrossingOutline) {
  for (const Ring& courtyard : {Ring{}, Ring{{1, 1}}, Ring{{1, 1}, {2, 1}}}) {
    const auto lobes = repaired({{{0, 0}, {30, 30}, {30, 40}, {10, 0}}, {courtyard}});
    EXPECT_EQ(lobes.were, Rings::Cross);
    EXPECT_NEAR(area_m2(lobes.polygons), 150.0, 1e-6);
  }
}

TEST(PolygonOverlay, WhatCannotBeDoneIsNoEmptyPolygon) {
  const Polygons whole{box(0, 0, 10, 10)};
  Polygons nowhere{box(5, 5, 15, 15)};
  nowhere[0].outer[2].x = std::nan("");
  EXPECT_THROW(static_cast<void>(united(whole, nowhere)), Error);
  EXPECT_THROW(static_cast<void>(subtracted(whole, nowhere)), Error);
  EXPECT_THROW(static_cast<void>(intersected(whole, nowhere)), Error);
  EXPECT_FALSE(simplified(nowhere, 0.05).empty());
}

TEST(PolygonOverlay, LineHasNoArea) {
  EXPECT_TRUE(repaired({{{0, 0}, {5, 5}, {0, 0}}, {}}).polygons.empty());
}

}  // namespace
}  // namespace sigmascape::geo
