#include "sigmascape/terrain/height_difference.h"

#include <cmath>
#include <functional>
#include <gtest/gtest.h>

#include "sigmascape/terrain/pyramid_levels.h"

namespace sigmascape::terrain {
namespace {

HeightField field_of(double spacing_m, double half_m, const std::function<double(double, double)>& height_m) {
  const auto nodes = static_cast<std::size_t>(std::lround(2.0 * half_m / spacing_m)) + 1;
  HeightField field{-half_m, half_m, spacing_m, Array2D<float>(nodes, nodes)};
  for (std::size_t row = 0; row < nodes; ++row) {
    for (std::size_t column = 0; column < nodes; ++column) {
      const double x = -half_m + static_cast<double>(column) * spacing_m;
      const double y = half_m - static_cast<double>(row) * spacing_m;
      field.height_m(column, row) = static_cast<float>(height_m(x, y));
    }
  }
  return field;
}

constexpr radar::Rectangle scene{-400.0, -400.0, 400.0, 400.0};

TEST(HeightDifference, OfTheSameTerrainIsNothingAndOfARaisedOneByHowMuch) {
  const auto hills = [](double x, double y) { return 30.0 * std::sin(x / 90.0) * std::cos(y / 70.0); };
  const HeightField field = field_of(4.0, 400.0, hills);
  TerrainPyramid same = pyramid_in_memory(field);
  const auto nothing = height_difference(same, field, scene);
  ASSERT_TRUE(nothing);
  EXPECT_NEAR(nothing->greatest_m, 0.0, 1e-4);
  TerrainPyramid raised =
      pyramid_in_memory(field_of(4.0, 2000.0, [&](double x, double y) { return hills(x, y) - 3.0; }));
  const auto three = height_difference(raised, field, scene);
  ASSERT_TRUE(three);
  EXPECT_NEAR(three->median_m, 3.0, 1e-3);
  EXPECT_NEAR(three->greatest_m, 3.0, 1e-3);
}

/// Between nodes s apart a chord lies up to c (s/2)² over z = c x², and over half of the way more than ¾ of that.
TEST(HeightDifference, OfCoarserNodesIsThatOfTheirChords) {
  const auto valley = [](double x, double) { return 1e-3 * x * x; };
  const HeightField field = field_of(1.0, 400.0, valley);
  TerrainPyramid coarse = pyramid_in_memory(field_of(80.0, 4000.0, valley));
  const auto apart = height_difference(coarse, field, scene);
  ASSERT_TRUE(apart);
  EXPECT_NEAR(apart->greatest_m, 1.6, 1e-3);
  EXPECT_NEAR(apart->median_m, 0.75 * 1.6, 0.05);
}

TEST(HeightDifference, IsThatWithinTheAreaAlone) {
  const auto cliff = [](double x, double) { return x > 200.0 ? 50.0 : 0.0; };
  const HeightField field = field_of(4.0, 400.0, cliff);
  TerrainPyramid level = pyramid_in_memory(field_of(4.0, 400.0, [](double, double) { return 0.0; }));
  const auto west = height_difference(level, field, {-400.0, -400.0, 100.0, 400.0});
  ASSERT_TRUE(west);
  EXPECT_EQ(west->greatest_m, 0.0);
  EXPECT_EQ(height_difference(level, field, scene)->greatest_m, 50.0);
  EXPECT_FALSE(height_difference(level, field, {5000.0, 5000.0, 6000.0, 6000.0}));
}

/// More than a million nodes.
TEST(HeightDifference, OfManyNodesIsThatOfSome) {
  const HeightField field = field_of(0.25, 400.0, [](double, double) { return 0.0; });
  TerrainPyramid slope = pyramid_in_memory(field_of(50.0, 400.0, [](double x, double) { return 0.01 * x; }));
  const auto apart = height_difference(slope, field, scene);
  ASSERT_TRUE(apart);
  EXPECT_NEAR(apart->greatest_m, 4.0, 0.02);
  EXPECT_NEAR(apart->median_m, 2.0, 0.02);
  EXPECT_NEAR(apart->nearly_all_m, 0.99 * 4.0, 0.02);
}

}  // namespace
}  // namespace sigmascape::terrain
