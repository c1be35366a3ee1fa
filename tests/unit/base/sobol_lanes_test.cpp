#include "sigmascape/base/sobol_lanes.h"

#include <gtest/gtest.h>

namespace sigmascape {
namespace {

TEST(SobolLanes, EachHasTheNumbersOfItsPoint) {
  for (std::uint32_t round = 0; round < 200; ++round) {
    SobolLanes lanes;
    std::vector<SobolPoint> points;
    for (std::uint32_t i = 0; i < lane_count; ++i) {
      points.emplace_back(hashed(round, i / 3), round * i);
      lanes.set(i, points.back());
    }
    PairLanes pairs;
    FloatLanes independent;
    draw_pairs(lanes, round, pairs);
    draw_independent(lanes, round, independent);
    for (std::size_t i = 0; i < lane_count; ++i) {
      EXPECT_EQ(pairs[i], points[i].pair(round));
      EXPECT_EQ(independent[i], points[i].independent(round));
    }
  }
}

}  // namespace
}  // namespace sigmascape
