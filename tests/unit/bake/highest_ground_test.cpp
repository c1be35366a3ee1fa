#include "sigmascape/bake/highest_ground.h"

#include <algorithm>
#include <gtest/gtest.h>

#include "sigmascape/base/hash.h"

namespace sigmascape::bake {
namespace {

/// Of sides that no power of squares fills.
terrain::HeightField rough_field() {
  terrain::HeightField field{-50.0, 80.0, 2.0, Array2D<float>(71, 22)};
  for (std::size_t i = 0; i < field.height_m.size(); ++i)
    field.height_m.values()[i] = 30.0F * unit_float(hashed(i)) - 40;
  return field;
}

double highest_node_m(const terrain::HeightField& field, const radar::Rectangle& within) {
  double highest_m = -1e9;
  for (std::size_t row = 0; row < field.height_m.rows(); ++row) {
    for (std::size_t column = 0; column < field.height_m.columns(); ++column) {
      const Vec2d node{field.west_m + field.spacing_m * static_cast<double>(column),
                       field.north_m - field.spacing_m * static_cast<double>(row)};
      if (within.contains(node)) highest_m = std::max(highest_m, static_cast<double>(field.height_m(column, row)));
    }
  }
  return highest_m;
}

TEST(HighestGround, IsTheHighestNodeOfEverySquare) {
  const terrain::HeightField field = rough_field();
  const HighestGround highest(field);
  const radar::Rectangle extent = field.extent();
  for (std::size_t level = 0; level < highest.levels(); ++level) {
    for (double y = extent.south_m; y <= extent.north_m; y += 3.0) {
      for (double x = extent.west_m; x <= extent.east_m; x += 3.0) {
        const HighestGround::Square square = highest.around({x, y}, level);
        ASSERT_TRUE(square.extent.contains({x, y})) << x << ", " << y << " at level " << level;
        ASSERT_EQ(square.highest_m, highest_node_m(field, square.extent)) << x << ", " << y << " at level " << level;
      }
    }
  }
}

TEST(HighestGround, ComesToOneSquareAtLast) {
  const terrain::HeightField field = rough_field();
  const HighestGround highest(field);
  EXPECT_EQ(highest.levels(), 5U);  // squares of 1, 4, 16, 64 and 256 of 70 × 21 cells
  EXPECT_EQ(highest.highest_m(), static_cast<double>(field.highest_m()));
  EXPECT_EQ(highest.around({-50.0, 80.0}, 0).extent, (radar::Rectangle{-50.0, 78.0, -48.0, 80.0}));
}

}  // namespace
}  // namespace sigmascape::bake
