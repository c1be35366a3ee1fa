#include "sigmascape/geo/raster_outline.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <gtest/gtest.h>
#include <numbers>
#include <utility>
#include <vector>

namespace sigmascape::geo {
namespace {

constexpr double half_m = 500.0;  // of the raster's side

/// A square about the origin, turned counter-clockwise.
RasterOutline turned_square(double angle_rad) {
  const auto turned = [&](double x, double y) {
    return Vec2d{x * std::cos(angle_rad) - y * std::sin(angle_rad), x * std::sin(angle_rad) + y * std::cos(angle_rad)};
  };
  std::vector<Vec2d> left, right, bottom, top;
  for (int i = -128; i <= 128; ++i) {
    const double t = half_m * i / 128.0;
    left.push_back(turned(-half_m, t));
    right.push_back(turned(half_m, t));
    bottom.push_back(turned(t, -half_m));
    top.push_back(turned(t, half_m));
  }
  return RasterOutline::of(left, right, bottom, top);
}

// Of a square that stands on its corner: as wide as its diagonal through the middle, and a corner is passed once or
// not.
TEST(RasterOutline, LinesGoInAndOutWhereItsEdgesAre) {
  const RasterOutline outline = turned_square(std::numbers::pi / 4.0);
  const double half_diagonal_m = half_m * std::numbers::sqrt2;
  for (const double y_m : {0.0, 100.0, -650.0}) {
    const std::vector<double> crossings_m = outline.crossings_m(y_m);
    ASSERT_EQ(crossings_m.size(), 2U) << y_m;
    EXPECT_NEAR(crossings_m.front(), std::abs(y_m) - half_diagonal_m, 1e-9);
    EXPECT_NEAR(crossings_m.back(), half_diagonal_m - std::abs(y_m), 1e-9);
  }
  EXPECT_TRUE(outline.crossings_m(half_diagonal_m + 1.0).empty());
  EXPECT_TRUE(outline.crossings_m(-half_diagonal_m - 1.0).empty());
  EXPECT_TRUE(RasterOutline().crossings_m(0.0).empty());
}

// A square in a square turned by θ has the side 1 / (|cos θ| + |sin θ|), and the one around it that many times it.
TEST(RasterOutline, SquareHoweverItIsTurned) {
  for (int deg = 0; deg < 360; deg += 15) {
    const double angle_rad = deg * std::numbers::pi / 180.0;
    const double cosine = std::cos(angle_rad), sine = std::sin(angle_rad);
    const double wider = std::abs(cosine) + std::abs(sine);
    const RasterOutline outline = turned_square(angle_rad);
    const Extent inside = outline.extent_inside(), around = outline.extent_around();
    const double side_m = 2.0 * half_m / wider;
    EXPECT_NEAR(outline.enclosed_m2(), 4.0 * half_m * half_m, 1e-3) << deg;
    EXPECT_NEAR((inside.east_m - inside.west_m) * (inside.north_m - inside.south_m), side_m * side_m,
                0.02 * side_m * side_m)
        << deg;
    for (const double x : {inside.west_m, inside.east_m}) {
      for (const double y : {inside.south_m, inside.north_m}) {
        EXPECT_LT(std::abs(x * cosine + y * sine), half_m + 1e-6) << deg;
        EXPECT_LT(std::abs(y * cosine - x * sine), half_m + 1e-6) << deg;
      }
    }
    for (const double reach_m : {-around.west_m, -around.south_m, around.east_m, around.north_m})
      EXPECT_NEAR(reach_m, half_m * wider, 1e-6) << deg;
  }
}

/// A square of which the southern edge rises to the east, to its middle.
RasterOutline rising_to_the_east() {
  std::vector<Vec2d> left, right, bottom, top;
  for (int i = 0; i <= 1000; ++i) {
    const double t = i - half_m;
    left.emplace_back(-half_m, t);
    right.emplace_back(half_m, 0.5 * i);
    bottom.emplace_back(t, -half_m + 0.5 * i);
    top.emplace_back(t, half_m);
  }
  return RasterOutline::of(left, right, bottom, top);
}

/// How many points of an edge a rectangle holds.
std::size_t points_in(const std::vector<Vec2d>& edge, const Extent& extent) {
  return static_cast<std::size_t>(std::ranges::count_if(edge, [&](Vec2d point) {
    return point.x >= extent.west_m && point.x <= extent.east_m && point.y >= extent.south_m &&
           point.y <= extent.north_m;
  }));
}

// A square of corners alone, 1000 m apart: 100 m of its western edge, and of its northern one, which runs along a side,
// lie in a rectangle.
TEST(RasterOutline, GetsPointsWhereARectangleLiesBetweenItsOwn) {
  const Vec2d south_west{-half_m, -half_m}, north_west{-half_m, half_m}, south_east{half_m, -half_m},
      north_east{half_m, half_m};
  const RasterOutline square = RasterOutline::of({south_west, north_west}, {south_east, north_east},
                                                 {south_west, south_east}, {north_west, north_east});
  const Extent west{-510.0, 0.0, -490.0, 100.0}, north{0.0, 490.0, 100.0, half_m};
  const RasterOutline refined = square.with_points_in(west, 5.0);
  EXPECT_EQ(points_in(square.west, west), 0U);
  EXPECT_GE(points_in(refined.west, west), 21U);
  EXPECT_LE(points_in(refined.west, west), 22U);
  for (const Vec2d& point : refined.west) EXPECT_EQ(point.x, -half_m);
  EXPECT_TRUE(std::ranges::is_sorted(refined.west, {}, &Vec2d::y)) << "along the edge";
  EXPECT_EQ(refined.east, square.east);
  EXPECT_EQ(refined.south, square.south);
  EXPECT_GE(points_in(square.with_points_in(north, 5.0).north, north), 21U);
  EXPECT_EQ(square.with_points_in({600.0, 0.0, 700.0, 100.0}, 5.0).east, square.east);
  EXPECT_TRUE(RasterOutline{}.with_points_in(west, 5.0).empty());
}

void expect_near(const Extent& found, const Extent& expected, double tolerance_m) {
  EXPECT_NEAR(found.west_m, expected.west_m, tolerance_m);
  EXPECT_NEAR(found.south_m, expected.south_m, tolerance_m);
  EXPECT_NEAR(found.east_m, expected.east_m, tolerance_m);
  EXPECT_NEAR(found.north_m, expected.north_m, tolerance_m);
}

// From the western edge u to the east the southern edge rises by u / 2, so that a rectangle has u (1000 - u / 2): the
// largest, of u = 1000, has none of what lies in the south-west. One that holds y = -430 has u = 140 at most.
TEST(RasterOutline, LargestRectangleAboutAnother) {
  const RasterOutline outline = rising_to_the_east();
  expect_near(outline.extent_inside(), {-500.0, 0.0, 500.0, 500.0}, 2.0);
  const Extent everywhere = outline.extent_around();
  expect_near(outline.extent_holding({-410.0, 100.0, -390.0, 120.0}, everywhere), {-500.0, 0.0, 500.0, 500.0}, 1.0);
  expect_near(outline.extent_holding({-410.0, -430.0, -390.0, -420.0}, everywhere), {-500.0, -430.0, -360.0, 500.0},
              1.0);
  expect_near(outline.extent_holding({-410.0, 100.0, -390.0, 120.0}, {-450.0, -300.0, -200.0, 200.0}),
              {-450.0, -300.0, -200.0, 200.0}, 1e-9);
  // Between -450 and e the edge is highest at e: (e + 450) (200 + 500 - (e + 500) / 2) is greatest at e = 225.
  expect_near(outline.extent_holding({-410.0, 100.0, -390.0, 120.0}, {-450.0, -600.0, 600.0, 200.0}),
              {-450.0, -137.5, 225.0, 200.0}, 1.0);
  // Turned about, the west is the east.
  RasterOutline mirrored = outline;
  for (auto* edge : {&mirrored.west, &mirrored.east, &mirrored.south, &mirrored.north}) {
    for (Vec2d& point : *edge) point.x = -point.x;
  }
  std::swap(mirrored.west, mirrored.east);
  expect_near(mirrored.extent_holding({390.0, -430.0, 410.0, -420.0}, everywhere), {360.0, -430.0, 500.0, 500.0}, 1.0);
}

}  // namespace
}  // namespace sigmascape::geo
