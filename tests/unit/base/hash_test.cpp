#include "sigmascape/base/hash.h"

#include <bit>
#include <gtest/gtest.h>
#include <set>

namespace sigmascape {
namespace {

// First outputs of the published generator from state 0: the increments of the state are part of the function here.
TEST(Mixed, IsSplitMix64) {
  static_assert(mixed(0) == 0xe220a8397b1dcdafULL);
  EXPECT_EQ(mixed(0), 0xe220a8397b1dcdafULL);
  EXPECT_EQ(mixed(0x9e3779b97f4a7c15ULL), 0x6e789e6aa1b965f4ULL);
  EXPECT_EQ(mixed(2 * 0x9e3779b97f4a7c15ULL), 0x06c45d188009454fULL);
}

TEST(Mixed, EveryInputBitTurnsHalfOfTheOutput) {
  for (unsigned bit = 0; bit < 64; ++bit) {
    int turned = 0;
    for (std::uint64_t x = 0; x < 256; ++x) turned += std::popcount(mixed(x) ^ mixed(x ^ (1ULL << bit)));
    EXPECT_NEAR(turned / 256.0, 32.0, 1.5) << "bit " << bit;
  }
}

TEST(Hashed, DependsOnOrderAndNumberOfWords) {
  EXPECT_NE(hashed(1, 2), hashed(2, 1));
  EXPECT_NE(hashed(1), hashed(1, 0));
  EXPECT_NE(hashed(0), hashed(0, 0));
}

TEST(Hashed, GridOfSmallWordsHasNoCollisions) {
  std::set<std::uint64_t> keys;
  for (std::uint32_t i = 0; i < 256; ++i) {
    for (std::uint32_t j = 0; j < 256; ++j) keys.insert(hashed(7, i - 128U, j - 128U));
  }
  EXPECT_EQ(keys.size(), 256U * 256U);
}

TEST(UnitFloat, StaysBelowOne) {
  EXPECT_EQ(unit_float(0), 0.0F);
  EXPECT_LT(unit_float(~0ULL), 1.0F);
  EXPECT_GT(unit_float(~0ULL), 0.9999999F);
  EXPECT_EQ(unit_float(1ULL << 63U), 0.5F);
}

}  // namespace
}  // namespace sigmascape
