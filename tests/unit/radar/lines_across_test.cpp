#include "sigmascape/radar/lines_across.h"

#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

namespace sigmascape::radar {
namespace {

TEST(LinesAcross, OfOneDepthHaveThat) {
  LinesAcross lines;
  EXPECT_EQ(lines.depth(), 0.0);
  for (const double weight : {1.0, 3.0}) lines.add(0.7, 0.7, weight);
  EXPECT_NEAR(lines.depth(), 0.7, 1e-12);

  // What stands behind is met anyway.
  LinesAcross in_a_wood;
  in_a_wood.add(0.7, 2.1);
  EXPECT_NEAR(in_a_wood.depth(), 0.7, 1e-12);
}

TEST(LinesAcross, LetAsMuchPassThroughGapsAsTheyDo) {
  LinesAcross lines;
  lines.add(2.0, 2.0, 3.0);
  lines.add(0.0, 0.0, 1.0);
  EXPECT_NEAR(std::exp(-lines.depth()), 0.75 * std::exp(-2.0) + 0.25, 1e-12);

  LinesAcross beside_a_wall;
  beside_a_wall.add(0.0, 0.0);
  beside_a_wall.add(1e6, 1e6);
  EXPECT_NEAR(beside_a_wall.depth(), std::numbers::ln2, 1e-12);
}

// Three squares behind one another whose gaps are in line let as much pass together as lines through all three.
TEST(LinesAcross, GapsGoOnThroughNeighbours) {
  LinesAcross each, all;
  for (const double depth : {0.0, 0.4, 1.3}) {
    each.add(depth, 3.0 * depth);
    all.add(3.0 * depth, 3.0 * depth);
  }
  EXPECT_NEAR(3.0 * each.depth(), all.depth(), 1e-12);
}

TEST(LinesAcross, HoweverDenseHaveADepth) {
  LinesAcross lines;
  lines.add(5e5, 5e5);
  lines.add(1e6, 1e6);
  EXPECT_NEAR(lines.depth(), 5e5 + std::numbers::ln2, 1e-6);
}

}  // namespace
}  // namespace sigmascape::radar
