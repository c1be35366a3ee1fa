#include "sigmascape/simulate/lattice_sums.h"

#include <gtest/gtest.h>

namespace sigmascape::simulate {
namespace {

// A mirror in one cell, passes without end, and a weak echo in another.
TEST(LatticeSums, HoldAnyNumberOfPassesOfABrightCell) {
  constexpr float bright_m2 = 0x1p23F, weak_m2 = 1e-3F;
  constexpr int passes = 1000;
  LatticeSums sums({.first = {0, 0}, .columns = 2, .rows = 1}, 1.0);
  for (int pass = 0; pass < passes; ++pass) {
    sums.add({0, 0}, radar::Channels{bright_m2, 0.0F, 0.0F, 0.0F}, {0.25, -0.5});
    sums.add({1, 0}, radar::Channels{weak_m2, 0.0F, 0.0F, 0.0F}, {0.0, 0.5});
    sums.make_room();
  }
  EXPECT_EQ(sums.overflows(), 0U);
  const LatticeSums::Sum bright = sums.sum(0, 0, 1.0 / passes), weak = sums.sum(1, 0, 1.0 / passes);
  EXPECT_FLOAT_EQ(bright.rcs_m2.vv, bright_m2);
  EXPECT_NEAR(bright.place.beam, 0.25, 1e-9);
  EXPECT_NEAR(bright.place.range, -0.5, 1e-9);
  EXPECT_NEAR(weak.rcs_m2.vv / weak_m2, 1.0F, 1e-5F);
  EXPECT_NEAR(weak.place.range, 0.5, 1e-5);
}

TEST(LatticeSums, CountWhatDoesNotFit) {
  LatticeSums sums({.first = {0, 0}, .columns = 1, .rows = 1}, 1.0);
  sums.add({0, 0}, radar::Channels{0x1p27F, 0.0F, 0.0F, 0.0F}, {});
  EXPECT_EQ(sums.overflows(), 1U);
  EXPECT_EQ(sums.sum(0, 0, 1.0).rcs_m2.vv, 0.0F);
}

}  // namespace
}  // namespace sigmascape::simulate
