#include "sigmascape/atlas/half.h"

#include <cmath>
#include <gtest/gtest.h>
#include <limits>

namespace sigmascape::atlas {
namespace {

/// What the bits mean by IEEE 754-2008, section 3.4, in double arithmetic.
double meaning(Half half) {
  const int exponent = (half >> 10U) & 31;
  const int mantissa = half & 1023;
  const double sign = (half & 0x8000U) != 0 ? -1.0 : 1.0;
  if (exponent == 31) return mantissa == 0 ? sign * std::numeric_limits<double>::infinity() : std::nan("");
  if (exponent == 0) return sign * std::ldexp(mantissa, -24);
  return sign * std::ldexp(1024 + mantissa, exponent - 25);
}

TEST(Half, EveryHalfMeansWhatTheStandardSays) {
  for (unsigned bits = 0; bits < 65536; ++bits) {
    const auto half = static_cast<Half>(bits);
    const float value = float_from_half(half);
    if (std::isnan(meaning(half))) {
      ASSERT_TRUE(std::isnan(value)) << bits;
    } else {
      ASSERT_EQ(static_cast<double>(value), meaning(half)) << bits;
      ASSERT_EQ(std::signbit(value), (bits & 0x8000U) != 0) << bits;
    }
  }
}

TEST(Half, EveryFiniteHalfMeansTheSameWithoutBranches) {
  for (unsigned bits = 0; bits < 65536; ++bits) {
    const auto half = static_cast<Half>(bits);
    if (!std::isfinite(meaning(half))) continue;
    ASSERT_EQ(static_cast<double>(float_from_finite_half(half)), meaning(half)) << bits;
    ASSERT_EQ(std::signbit(float_from_finite_half(half)), (bits & 0x8000U) != 0) << bits;
  }
}

TEST(Half, EveryHalfSurvivesTheRoundTrip) {
  for (unsigned bits = 0; bits < 65536; ++bits) {
    const auto half = static_cast<Half>(bits);
    if (std::isnan(meaning(half))) {
      ASSERT_TRUE(std::isnan(float_from_half(half_from_float(float_from_half(half))))) << bits;
    } else {
      ASSERT_EQ(half_from_float(float_from_half(half)), half) << bits;
    }
  }
}

TEST(Half, BetweenAnyTwoNeighboursTheNearerIsTakenAndOfTwoTheEvenOne) {
  for (unsigned bits = 0; bits < 0x7bffU; ++bits) {
    const auto lower = static_cast<Half>(bits);
    const auto upper = static_cast<Half>(bits + 1);
    const auto middle = static_cast<float>((meaning(lower) + meaning(upper)) / 2.0);
    ASSERT_EQ(half_from_float(middle), bits % 2 == 0 ? lower : upper) << bits;
    ASSERT_EQ(half_from_float(std::nextafter(middle, 0.0F)), lower) << bits;
    ASSERT_EQ(half_from_float(std::nextafter(middle, 1e9F)), upper) << bits;
    ASSERT_EQ(half_from_float(-middle), static_cast<Half>((bits % 2 == 0 ? lower : upper) | 0x8000U)) << bits;
  }
}

TEST(Half, BeyondTheLargestLiesInfinity) {
  EXPECT_EQ(float_from_half(half_from_float(largest_half)), 65504.0F);
  EXPECT_EQ(float_from_half(half_from_float(std::nextafter(65520.0F, 0.0F))), 65504.0F);
  EXPECT_TRUE(std::isinf(float_from_half(half_from_float(65520.0F))));
  EXPECT_TRUE(std::isinf(float_from_half(half_from_float(1e30F))));
  EXPECT_TRUE(std::isinf(float_from_half(half_from_float(std::numeric_limits<float>::infinity()))));
  EXPECT_TRUE(std::isnan(float_from_half(half_from_float(std::numeric_limits<float>::quiet_NaN()))));
  EXPECT_EQ(half_from_float(std::numeric_limits<float>::denorm_min()), 0);
}

class FewerMantissaBits : public testing::TestWithParam<int> {};

TEST_P(FewerMantissaBits, LeaveTheNearestHalfOfThatWidth) {
  const int bits = GetParam();
  const unsigned below = (1U << static_cast<unsigned>(10 - bits)) - 1U;
  for (int i = 0; i < 200000; ++i) {
    const float value = std::ldexp(1.0F + static_cast<float>(i % 4999) / 4999.0F, i % 40 - 27);
    const Half half = half_from_float(value, bits);
    if (value >= 0x1p-14F) {
      ASSERT_EQ(half & below, 0U) << value;
    }
    const double step = std::ldexp(1.0, std::max(std::ilogb(value) - bits, -24));
    ASSERT_LE(std::abs(meaning(half) - static_cast<double>(value)), step / 2.0) << value;
  }
}

TEST_P(FewerMantissaBits, BreakTiesToTheEvenStep) {
  const int bits = GetParam();
  const double step = std::ldexp(1.0, -bits);
  EXPECT_EQ(meaning(half_from_float(static_cast<float>(1.0 + 0.5 * step), bits)), 1.0);
  EXPECT_EQ(meaning(half_from_float(static_cast<float>(1.0 + 1.5 * step), bits)), 1.0 + 2.0 * step);
}

INSTANTIATE_TEST_SUITE_P(Half, FewerMantissaBits, testing::Range(1, 11));

}  // namespace
}  // namespace sigmascape::atlas
