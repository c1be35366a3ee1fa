#include "sigmascape/scene/convex_polygon.h"

#include <cmath>
#include <gtest/gtest.h>

namespace sigmascape::scene {
namespace {

const ConvexPolygon rectangle{{0.0, 0.0}, {30.0, 0.0}, {30.0, 20.0}, {0.0, 20.0}};

TEST(ConvexPolygon, InsetMovesEveryEdgeInward) {
  EXPECT_NEAR(area_m2(inset(rectangle, 4.0)), 22.0 * 12.0, 1e-9);
  EXPECT_TRUE(inset(rectangle, 11.0).empty());
}

TEST(ConvexPolygon, LeftPartsOfBothDirectionsMakeTheWhole) {
  const Vec2d on_cut{12.0, 3.0}, cut{0.6, 0.8};
  const double left = area_m2(left_part(rectangle, on_cut, cut)),
               right = area_m2(left_part(rectangle, on_cut, cut * -1.0));
  EXPECT_GT(left, 1.0);
  EXPECT_GT(right, 1.0);
  EXPECT_NEAR(left + right, 600.0, 1e-9);
}

TEST(ConvexPolygon, PartitionCoversThePolygonWithPiecesOfAboutTheTarget) {
  const ConvexPolygon land{{0.0, 0.0}, {900.0, 0.0}, {900.0, 700.0}, {0.0, 700.0}};
  double sum = 0.0;
  for (const ConvexPolygon& part : partitioned(land, 0.4, {.target_area_m2 = 5000.0}, 9)) {
    sum += area_m2(part);
    EXPECT_LT(area_m2(part), 1.81 * 5000.0);
  }
  EXPECT_NEAR(sum, 630'000.0, 1e-3);
}

TEST(ConvexPolygon, CellsAreThoseWithTheirCentreInside) {
  const radar::GroundGrid grid{.west_m = -40.0, .north_m = 40.0, .cell_m = 0.5, .columns = 160, .rows = 160};
  const ConvexPolygon turned = oriented_rectangle({3.0, -2.0}, {0.8, 0.6}, 20.0, 10.0);
  std::size_t cells = 0;
  for_each_cell(grid, turned, [&](std::size_t column, std::size_t row) {
    const Vec2d from_centre = grid.centre_of(column, row) - Vec2d{3.0, -2.0};
    EXPECT_LE(std::abs(dot(from_centre, Vec2d{0.8, 0.6})), 10.0 + 1e-9);
    EXPECT_LE(std::abs(cross(from_centre, Vec2d{0.8, 0.6})), 5.0 + 1e-9);
    ++cells;
  });
  EXPECT_NEAR(static_cast<double>(cells), 200.0 / 0.25, 12.0);
}

TEST(ConvexPolygon, CellsOffTheGridAreLeftOut) {
  const radar::GroundGrid grid{.west_m = 0.0, .north_m = 10.0, .cell_m = 1.0, .columns = 10, .rows = 10};
  std::size_t cells = 0;
  for_each_cell(grid, oriented_rectangle({0.0, 0.0}, {1.0, 0.0}, 8.0, 6.0), [&](std::size_t, std::size_t) { ++cells; });
  EXPECT_EQ(cells, 12U);
  for_each_cell(grid, oriented_rectangle({-50.0, 70.0}, {1.0, 0.0}, 8.0, 6.0),
                [&](std::size_t, std::size_t) { ++cells; });
  EXPECT_EQ(cells, 12U);
}

}  // namespace
}  // namespace sigmascape::scene
