#include "sigmascape/geo/polygon_triangulation.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <vector>

namespace sigmascape::geo {
namespace {

const Ring square{{0, 0}, {20, 0}, {20, 20}, {0, 20}};

std::vector<Vec2d> corners_of(const Polygon& polygon) {
  std::vector<Vec2d> corners = polygon.outer;
  for (const Ring& hole : polygon.holes) corners.insert(corners.end(), hole.begin(), hole.end());
  return corners;
}

/// The polygon seen from one of eight sides, mirrored or not.
Polygon seen_from(const Polygon& polygon, int side) {
  const auto seen = [&](Ring ring, bool counter_clockwise) {
    for (Vec2d& corner : ring) {
      if ((side & 1) != 0) corner.x = -corner.x;
      if ((side & 2) != 0) corner.y = -corner.y;
      if ((side & 4) != 0) corner = {corner.y, corner.x};
    }
    return tidy_ring(ring, counter_clockwise);
  };
  Polygon result{seen(polygon.outer, true), {}};
  for (const Ring& hole : polygon.holes) result.holes.push_back(seen(hole, false));
  return result;
}

/// Counter-clockwise triangles between corners of the polygon that sum to its area.
void expect_filled(const Polygon& polygon) {
  const std::vector<Vec2d> corners = corners_of(polygon);
  double area = 0.0;
  for (const auto& [a, b, c] : triangulated(polygon)) {
    const double twice = cross(b - a, c - a);
    EXPECT_GT(twice, 0.0);
    area += twice / 2.0;
    for (const Vec2d& corner : {a, b, c}) EXPECT_NE(std::ranges::find(corners, corner), corners.end());
  }
  EXPECT_NEAR(area, area_m2(polygon), 1e-9);
}

TEST(PolygonTriangulation, TrianglesFillAPolygonWithHolesAndLeaveTheHolesOpen) {
  Polygon yard{{{0, 0}, {20, 0}, {20, 10}, {0, 10}}, {}};
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

// GEOS finds no bridge from the southern courtyard to the outline.
TEST(PolygonTriangulation, FillsAroundTwoCourtyardsFromWhateverSide) {
  const Polygon yards{square, {{{7, 4}, {11, 4}, {9, 1}}, {{1, 2}, {2, 11}, {9, 5}}}};
  for (int side = 0; side < 8; ++side) expect_filled(seen_from(yards, side));
}

TEST(PolygonTriangulation, FillsAroundACourtyardWhoseCornerLiesOnTheOutline) {
  const Polygon on_an_edge{square, {{{10, 0}, {6, 8}, {14, 8}}}};
  const Polygon on_a_corner{square, {{{0, 0}, {6, 12}, {12, 6}}}};
  const Polygon on_one_another{square, {{{4, 4}, {4, 10}, {10, 10}, {10, 4}}, {{10, 7}, {16, 10}, {16, 5}}}};
  for (int side = 0; side < 8; ++side) {
    for (const Polygon& polygon : {on_an_edge, on_a_corner, on_one_another}) expect_filled(seen_from(polygon, side));
  }
}

}  // namespace
}  // namespace sigmascape::geo
