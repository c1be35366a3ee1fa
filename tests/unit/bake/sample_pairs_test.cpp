#include "sigmascape/bake/sample_pairs.h"

#include <cmath>
#include <cstdint>
#include <gtest/gtest.h>
#include <utility>

namespace sigmascape::bake {
namespace {

TEST(SamplePairs, EachButTheLastOfAnOddNumberHasOneBesideIt) {
  for (std::uint32_t samples = 2; samples <= 300; ++samples) {
    const SamplePairs pairs(samples);
    for (std::uint32_t sample = 0; sample < samples; ++sample) {
      ASSERT_EQ(pairs.is_alone(sample), samples % 2 == 1 && sample + 1 == samples);
      if (pairs.is_alone(sample)) continue;
      const std::uint32_t other = pairs.beside(sample);
      ASSERT_LT(other, samples) << sample << " of " << samples;
      ASSERT_NE(other, sample);
      ASSERT_EQ(pairs.beside(other), sample);
    }
  }
}

// A hundred samples are runs of 64, 32 and 4, whose pairs share squares of a 32nd of the cell, boxes of a 16th and of a
// half.
TEST(SamplePairs, LieBesideOneAnotherAsCloseAsTheirRunIsLong) {
  const SamplePairs pairs(100);
  const auto box = [](std::uint32_t sample, int across, int down) {
    const Vec2f point = SobolPoint(5, sample).pair(0);
    return std::pair(std::floor(std::ldexp(point.x, across)), std::floor(std::ldexp(point.y, down)));
  };
  for (std::uint32_t sample = 0; sample < 100; ++sample) {
    const int across = sample < 64 ? 3 : sample < 96 ? 2 : 1, down = sample < 96 ? 2 : 0;
    EXPECT_EQ(box(pairs.beside(sample), across, down), box(sample, across, down)) << sample;
  }
}

}  // namespace
}  // namespace sigmascape::bake
