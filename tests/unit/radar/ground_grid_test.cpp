#include "sigmascape/radar/ground_grid.h"

#include <gtest/gtest.h>

#include "sigmascape/radar/rectangle_parts.h"

namespace sigmascape::radar {
namespace {

constexpr GroundGrid grid{.west_m = -10.0, .north_m = 30.0, .cell_m = 2.5, .columns = 4, .rows = 6};

TEST(GroundGrid, RowZeroIsTheNorthernmost) {
  EXPECT_EQ(grid.centre_of(0, 0), (Vec2d{-8.75, 28.75}));
  EXPECT_EQ(grid.centre_of(3, 5), (Vec2d{-1.25, 16.25}));
}

TEST(GroundGrid, ExtentCoversAllCells) {
  EXPECT_EQ(grid.extent(), (Rectangle{-10.0, 15.0, 0.0, 30.0}));
  EXPECT_EQ(grid.cell_area_m2(), 6.25);
  EXPECT_EQ(grid.extent().width_m() * grid.extent().height_m(), 4 * 6 * grid.cell_area_m2());
}

TEST(GroundGrid, CellsFromIsTheInverseOfCentreOf) {
  for (std::size_t row = 0; row < grid.rows; ++row) {
    for (std::size_t column = 0; column < grid.columns; ++column) {
      EXPECT_EQ(grid.cells_from(grid.centre_of(column, row)),
                (Vec2d{static_cast<double>(column) + 0.5, static_cast<double>(row) + 0.5}));
    }
  }
  EXPECT_EQ(grid.cells_from({-10.0, 30.0}), (Vec2d{0.0, 0.0}));
}

TEST(Rectangle, ContainsItsEdges) {
  constexpr Rectangle rectangle{-1.0, -2.0, 3.0, 4.0};
  EXPECT_EQ(rectangle.centre(), (Vec2d{1.0, 1.0}));
  EXPECT_TRUE(rectangle.contains({3.0, -2.0}));
  EXPECT_FALSE(rectangle.contains({3.1, 0.0}));
  EXPECT_FALSE(rectangle.contains({0.0, -2.1}));
}

TEST(Rectangle, HasPartsInCommonAndGrows) {
  constexpr Rectangle a{0.0, 0.0, 4.0, 2.0}, b{3.0, -1.0, 9.0, 1.0};
  EXPECT_EQ(common_part(a, b), (Rectangle{3.0, 0.0, 4.0, 1.0}));
  EXPECT_EQ(common_part(a, b), common_part(b, a));
  EXPECT_LT(common_part(a, {5.0, 0.0, 6.0, 2.0}).width_m(), 0.0);
  EXPECT_EQ(widened(a, 0.5), (Rectangle{-0.5, -0.5, 4.5, 2.5}));
}

}  // namespace
}  // namespace sigmascape::radar
