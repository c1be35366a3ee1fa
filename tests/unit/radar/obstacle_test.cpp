#include "sigmascape/radar/obstacle.h"

#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

namespace sigmascape::radar {
namespace {

constexpr Obstacle none{};
constexpr Obstacle wall{.solid_top_m = 8.0F};
constexpr double side_m = 4.0;

void expect_near(const Obstacle& merged, const Obstacle& expected) {
  EXPECT_FLOAT_EQ(merged.solid_top_m, expected.solid_top_m);
  EXPECT_FLOAT_EQ(merged.crown_base_m, expected.crown_base_m);
  EXPECT_FLOAT_EQ(merged.crown_top_m, expected.crown_top_m);
  EXPECT_FLOAT_EQ(merged.crown_extinction_per_m, expected.crown_extinction_per_m);
}

TEST(MergedObstacles, SolidsKeepTheShadowedArea) {
  // Alone: half as wide as the square, so half as high. A row along one way of looking: as it is from the side, half
  // as wide from its end.
  EXPECT_FLOAT_EQ(merged(wall, none, none, none, side_m).solid_top_m, 4.0F);
  EXPECT_FLOAT_EQ(merged(wall, wall, none, none, side_m).solid_top_m, 6.0F);
  EXPECT_FLOAT_EQ(merged(wall, wall, wall, wall, side_m).solid_top_m, 8.0F);
}

/// The extinction by which as much passes as half and half of two depths.
double half_and_half(double one, double other) {
  return -std::log((std::exp(-one) + std::exp(-other)) / 2.0);
}

// Trees of 0.8 across a square and 1.6 upwards.
TEST(MergedObstacles, CrownsLetAsMuchPassAsLinesBetweenThem) {
  const Obstacle tree{.crown_base_m = 2.0F, .crown_top_m = 10.0F, .crown_extinction_per_m = 0.2F};
  const auto with = [&tree](double eastward, double northward, double upward) {
    Obstacle grove = tree;
    grove.crown_extinction_per_m = static_cast<float>((eastward / 8.0 + northward / 8.0 + upward / 8.0) / 3.0);
    return grove;
  };
  expect_near(merged(tree, tree, tree, tree, side_m), tree);
  // Every line across is as far in a tree, half of those upwards miss them.
  expect_near(merged(tree, none, none, tree, side_m), with(0.8, 0.8, half_and_half(1.6, 0.0)));
  // Seen along the row half of the lines pass two trees, the others none; across it all pass one.
  expect_near(merged(tree, tree, none, none, side_m), with(half_and_half(1.6, 0.0), 0.8, half_and_half(1.6, 0.0)));
  // However dense, half of what comes from the side passes beside it, and three quarters of what comes from above.
  Obstacle dense = tree;
  dense.crown_extinction_per_m = 1e4F;
  expect_near(merged(none, none, dense, none, side_m), with(std::numbers::ln2, std::numbers::ln2, std::log(4.0 / 3.0)));
}

// Depths upwards of 1.6 and 7.2 say where both begin and end. From 2 to 18 m each way of looking across has a row or
// column of each; the depth of that is kept between base and top.
TEST(MergedObstacles, CrownsAtOtherHeightsPassOneAnother) {
  const Obstacle tree{.crown_base_m = 2.0F, .crown_top_m = 10.0F, .crown_extinction_per_m = 0.2F};
  const Obstacle dense{.crown_base_m = 6.0F, .crown_top_m = 18.0F, .crown_extinction_per_m = 0.6F};
  const double base_m = (1.6 * 2.0 + 7.2 * 6.0) / 8.8, top_m = (1.6 * 10.0 + 7.2 * 18.0) / 8.8;
  const double across = -std::log((8.0 * std::exp(-0.8) + 8.0 + 12.0 * std::exp(-2.4) + 4.0) / 32.0),
               upward = -std::log((2.0 + std::exp(-1.6) + std::exp(-7.2)) / 4.0);
  const double kappa = (2.0 * across / 8.0 * 16.0 + upward) / 3.0 / (top_m - base_m);
  expect_near(merged(none, tree, dense, none, side_m), {.crown_base_m = static_cast<float>(base_m),
                                                        .crown_top_m = static_cast<float>(top_m),
                                                        .crown_extinction_per_m = static_cast<float>(kappa)});
}

TEST(MergedObstacles, ThinCrownsKeepTheMeanDepth) {
  const Obstacle tree{.crown_base_m = 2.0F, .crown_top_m = 10.0F, .crown_extinction_per_m = 0.0002F};
  const Obstacle dense{.crown_base_m = 6.0F, .crown_top_m = 18.0F, .crown_extinction_per_m = 0.0006F};
  const Obstacle wood = merged(none, tree, dense, none, side_m);
  EXPECT_NEAR(wood.crown_extinction_per_m * (wood.crown_top_m - wood.crown_base_m), 0.0088F / 4.0F, 1e-5F);
}

TEST(MergedObstacles, CrownsFlatterThanNumbersTellAreNone) {
  EXPECT_EQ(
      merged(none, {.crown_base_m = 5.0F, .crown_top_m = 5.0F, .crown_extinction_per_m = 65504.0F}, none, none, side_m),
      none);
  // Of whatever the next number above 5 m gives, something that can be stored.
  const Obstacle sheet{
      .crown_base_m = 5.0F, .crown_top_m = std::nextafter(5.0F, 6.0F), .crown_extinction_per_m = 210000.0F};
  for (const Obstacle& other : {none, sheet})
    EXPECT_TRUE(std::isfinite(merged(sheet, other, none, other, side_m).crown_extinction_per_m));
}

TEST(HalvedObstacles, StandWhereTheFourStoodTheyCover) {
  ObstacleMap finer{{-4.0, 6.0, 2.0, 4, 2}, Array2D<Obstacle>(4, 2)};
  finer.obstacles(3, 0) = finer.obstacles(3, 1) = wall;
  const ObstacleMap coarser = halved(finer);
  EXPECT_EQ(coarser.grid, (GroundGrid{-4.0, 6.0, 4.0, 2, 1}));
  ASSERT_EQ(coarser.obstacles.columns(), 2U);
  ASSERT_EQ(coarser.obstacles.rows(), 1U);
  EXPECT_EQ(coarser.obstacles(0, 0), none);
  EXPECT_FLOAT_EQ(coarser.obstacles(1, 0).solid_top_m, 6.0F);
}

}  // namespace
}  // namespace sigmascape::radar
