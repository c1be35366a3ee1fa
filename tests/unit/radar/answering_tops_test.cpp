#include "sigmascape/radar/answering_tops.h"

#include <algorithm>
#include <cstdlib>
#include <gtest/gtest.h>

#include "sigmascape/base/hash.h"

namespace sigmascape::radar {
namespace {

TEST(AnsweringTops, ThingsAnswerAsFarBeforeThemAsTheyLieOver) {
  EXPECT_EQ(layover_squares(3.0, 2.0), 1U) << "less than a square, and one more";
  EXPECT_EQ(layover_squares(20.0, 2.0), 3U) << "5 m and a square more";
  ObstacleMap map{{0.0, 42.0, 2.0, 21, 21}, Array2D<Obstacle>(21, 21)};
  map.obstacles(10, 10) = {.solid_top_m = 20.0F};
  map.obstacles(11, 10) = {.crown_base_m = 2.0F, .crown_top_m = 6.0F, .crown_extinction_per_m = 0.1F};
  const AnsweringTops tops = answering_tops(map, FromAfar::Hidden);
  EXPECT_EQ(tops.at(map.grid.centre_of(13, 7)), 20.0F);
  EXPECT_EQ(tops.at(map.grid.centre_of(11, 10)), 20.0F) << "the higher of two";
  EXPECT_EQ(tops.at(map.grid.centre_of(14, 10)), 0.0F);
  EXPECT_EQ(tops.at(map.grid.centre_of(10, 14)), 0.0F);
  EXPECT_EQ(tops.at({-1.0, 20.0}), 0.0F);
}

TEST(AnsweringTops, WhereNothingReachesWhatComesFromAfarIsHiddenByNothing) {
  ObstacleMap map{{0.0, 42.0, 2.0, 21, 21}, Array2D<Obstacle>(21, 21)};
  map.obstacles(10, 10) = {.solid_top_m = 20.0F};
  const AnsweringTops tops = answering_tops(map, FromAfar::Unhidden);
  EXPECT_EQ(tops.at(map.grid.centre_of(13, 10)), 20.0F);
  EXPECT_EQ(tops.at(map.grid.centre_of(14, 10)), from_afar_m);
  EXPECT_EQ(tops.at({-1.0, 20.0}), 0.0F) << "of ground outside nothing is known";
}

TEST(AnsweringTops, AreTheHighestOfAllThatReachASquare) {
  constexpr std::size_t columns = 60, rows = 47;
  constexpr double cell_m = 2.0;
  Array2D<float> standing_m(columns, rows);
  for (std::size_t i = 0; i < standing_m.size(); ++i) {
    const float lot = unit_float(hashed(7, i));
    if (lot < 0.1F) standing_m.values()[i] = 900.0F * lot * lot * lot * 100.0F;
  }
  const Array2D<float> overlying_m = overlying_tops_m(standing_m, cell_m);
  const auto apart = [](std::size_t a, std::size_t b) { return a > b ? a - b : b - a; };
  for (std::size_t row = 0; row < rows; ++row) {
    for (std::size_t column = 0; column < columns; ++column) {
      float highest_m = 0.0F;
      for (std::size_t j = 0; j < rows; ++j) {
        for (std::size_t i = 0; i < columns; ++i) {
          const float top_m = standing_m(i, j);
          const std::size_t reach = layover_squares(static_cast<double>(top_m), cell_m);
          if (std::max(apart(column, i), apart(row, j)) <= reach) highest_m = std::max(highest_m, top_m);
        }
      }
      ASSERT_EQ(overlying_m(column, row), highest_m) << column << " " << row;
    }
  }
}

}  // namespace
}  // namespace sigmascape::radar
