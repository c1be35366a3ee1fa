#include "sigmascape/radar/obstacle.h"

#include <gtest/gtest.h>

namespace sigmascape::radar {
namespace {

constexpr Obstacle none{};
constexpr Obstacle wall{.solid_top_m = 8.0F};

TEST(MergedObstacles, SolidsKeepTheShadowedArea) {
  // Alone: half as wide as the square, so half as high. A row along one way of looking: as it is from the side, half
  // as wide from its end.
  EXPECT_FLOAT_EQ(merged(wall, none, none, none).solid_top_m, 4.0F);
  EXPECT_FLOAT_EQ(merged(wall, wall, none, none).solid_top_m, 6.0F);
  EXPECT_FLOAT_EQ(merged(wall, wall, wall, wall).solid_top_m, 8.0F);
}

TEST(MergedObstacles, CrownsKeepTheMeanExtinction) {
  const Obstacle tree{.crown_base_m = 2.0F, .crown_top_m = 10.0F, .crown_extinction_per_m = 0.2F};
  const Obstacle grove = merged(tree, none, none, tree);
  EXPECT_FLOAT_EQ(grove.crown_extinction_per_m, 0.1F);
  EXPECT_FLOAT_EQ(grove.crown_base_m, 2.0F);
  EXPECT_FLOAT_EQ(grove.crown_top_m, 10.0F);

  // The denser crown has more to say of where both begin and end: 2 + 3/4 · 4 and 10 + 3/4 · 8.
  const Obstacle dense{.crown_base_m = 6.0F, .crown_top_m = 18.0F, .crown_extinction_per_m = 0.6F};
  const Obstacle wood = merged(none, tree, dense, none);
  EXPECT_FLOAT_EQ(wood.crown_extinction_per_m, 0.2F);
  EXPECT_FLOAT_EQ(wood.crown_base_m, 5.0F);
  EXPECT_FLOAT_EQ(wood.crown_top_m, 16.0F);
}

TEST(HalvedObstacles, StandWhereTheFourStoodTheyCover) {
  Array2D<Obstacle> finer(4, 2);
  finer(3, 0) = finer(3, 1) = wall;
  const Array2D<Obstacle> coarser = halved(finer);
  ASSERT_EQ(coarser.columns(), 2U);
  ASSERT_EQ(coarser.rows(), 1U);
  EXPECT_EQ(coarser(0, 0), none);
  EXPECT_FLOAT_EQ(coarser(1, 0).solid_top_m, 6.0F);
}

}  // namespace
}  // namespace sigmascape::radar
