#include "sigmascape/radar/ground_stretch.h"

#include <cmath>
#include <gtest/gtest.h>

namespace sigmascape::radar {
namespace {

constexpr Rectangle ground{100.0, -50.0, 300.0, 50.0};

TEST(GroundStretch, CrossesFromSideToSide) {
  const auto eastwards = stretch_within(ground, {0.0, 0.0}, {1.0, 0.0});
  EXPECT_EQ(eastwards.begin_m, 100.0);
  EXPECT_EQ(eastwards.end_m, 300.0);
  // At 45° through the corner region: in by the western side at √2 · 100, out by the northern at √2 · 120.
  const double diagonal = 1.0 / std::sqrt(2.0);
  const auto rising = stretch_within(ground, {0.0, -70.0}, {diagonal, diagonal});
  EXPECT_NEAR(rising.begin_m, 100.0 * std::sqrt(2.0), 1e-9);
  EXPECT_NEAR(rising.end_m, 120.0 * std::sqrt(2.0), 1e-9);
}

TEST(GroundStretch, BeginsWhereTheWayBeginsWithin) {
  const auto westwards = stretch_within(ground, {200.0, 0.0}, {-1.0, 0.0});
  EXPECT_EQ(westwards.begin_m, 0.0);
  EXPECT_EQ(westwards.end_m, 100.0);
}

TEST(GroundStretch, IsEmptyForWaysThatPassBy) {
  EXPECT_TRUE(stretch_within(ground, {0.0, 60.0}, {1.0, 0.0}).empty());
  EXPECT_TRUE(stretch_within(ground, {0.0, 0.0}, {-1.0, 0.0}).empty());
  EXPECT_TRUE(stretch_within(ground, {0.0, 0.0}, {0.0, 1.0}).empty());
  EXPECT_FALSE(stretch_within(ground, {0.0, 50.0}, {1.0, 0.0}).empty());  // along the edge
}

}  // namespace
}  // namespace sigmascape::radar
