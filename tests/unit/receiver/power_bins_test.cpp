#include "sigmascape/receiver/power_bins.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <vector>

#include "sigmascape/base/hash.h"
#include "sigmascape/base/parallel.h"

namespace sigmascape::receiver {
namespace {

radar::Channels all(float value) {
  return {value, 0.5F * value, 0.25F * value, -0.5F * value};
}

/// Powers over twelve orders of magnitude, which floating-point sums would not take in any order.
std::vector<radar::Channels> many_powers() {
  std::vector<radar::Channels> powers;
  for (std::uint64_t i = 0; i < 20'000; ++i)
    powers.push_back(all(std::pow(10.0F, -8.0F + 12.0F * unit_float(hashed(i)))));
  return powers;
}

TEST(PowerBins, SumsDoNotDependOnOrder) {
  auto powers = many_powers();
  PowerBins forwards(1, 1), backwards(1, 1);
  for (const auto& power : powers) forwards.add(0, 0, power);
  std::ranges::reverse(powers);
  for (const auto& power : powers) backwards.add(0, 0, power);
  EXPECT_EQ(forwards.sum(0, 0), backwards.sum(0, 0));
  EXPECT_EQ(forwards.total(), backwards.total());
  double exact = 0.0;
  for (const auto& power : powers) exact += static_cast<double>(power.vv);
  EXPECT_NEAR(forwards.total()[0] / exact, 1.0, 1e-10);
}

TEST(PowerBins, SumsDoNotDependOnThreads) {
  const auto powers = many_powers();
  const auto sums_with = [&](unsigned threads) {
    PowerBins bins(7, 5);
    parallel_for(powers.size(), threads, [&](std::size_t i, unsigned) {
      bins.add_shared(7.0 * static_cast<double>(unit_float(hashed(i, 1))),
                      5.0 * static_cast<double>(unit_float(hashed(i, 2))), powers[i]);
    });
    return bins.sums();
  };
  const auto one = sums_with(1), four = sums_with(4);
  EXPECT_TRUE(std::ranges::equal(one.values(), four.values()));
}

TEST(PowerBins, AColumnSummedByItselfIsTheSame) {
  const auto powers = many_powers();
  PowerBins one_by_one(3, 9), at_once(3, 9);
  for (const int pass : {0, 1}) {
    PowerLine line(9);
    for (std::size_t i = 0; i < powers.size(); ++i) {
      // Some fall beside the bins, wholly or in part.
      const double place = 11.0 * static_cast<double>(unit_float(hashed(i, pass))) - 1.0;
      one_by_one.add_shared(1.5, place, powers[i]);
      line.add_shared(place, powers[i]);
    }
    at_once.add_column(1, line);
  }
  EXPECT_TRUE(std::ranges::equal(one_by_one.sums().values(), at_once.sums().values()));
  EXPECT_GT(at_once.sum(1, 0).vv, 0.0F);
  EXPECT_EQ(at_once.sum(0, 4), radar::Channels{});
}

TEST(PowerBins, ALineLeavesOutAndCountsWhatDoesNotFit) {
  PowerBins bins(1, 3);
  PowerLine line(3);
  line.add_shared(1.5, {1e9F, 1.0F, 0.0F, -1e9F});
  line.add_shared(1.5, {1.0F, 1.0F, 0.0F, 0.0F});
  bins.add_column(0, line);
  EXPECT_EQ(bins.overflows(), 2U);
  EXPECT_EQ(bins.sum(0, 1), (radar::Channels{1.0F, 2.0F, 0.0F, 0.0F}));
}

TEST(PowerBins, AddGoesToOneBin) {
  PowerBins bins(3, 2);
  bins.add(2, 1, all(4.0F));
  EXPECT_EQ(bins.sum(2, 1), all(4.0F));
  EXPECT_EQ(bins.sums()(2, 1), all(4.0F));
  EXPECT_EQ(bins.sum(1, 1), radar::Channels{});
  EXPECT_EQ(bins.total()[3], -2.0);
}

TEST(PowerBins, SharingKeepsPowerAndCentroid) {
  for (std::uint64_t k = 0; k < 200; ++k) {
    const double column = 2.0 + 4.0 * static_cast<double>(unit_float(hashed(k, 1)));
    const double row = 2.0 + 3.0 * static_cast<double>(unit_float(hashed(k, 2)));
    PowerBins bins(8, 7);
    bins.add_shared(column, row, all(3.0F));
    double power = 0.0, across = 0.0, down = 0.0;
    int touched = 0;
    for (std::size_t r = 0; r < 7; ++r) {
      for (std::size_t c = 0; c < 8; ++c) {
        const double here = static_cast<double>(bins.sum(c, r).vv);
        power += here;
        across += here * (static_cast<double>(c) + 0.5);
        down += here * (static_cast<double>(r) + 0.5);
        touched += here > 0.0 ? 1 : 0;
      }
    }
    EXPECT_NEAR(power / 3.0, 1.0, 1e-5);
    EXPECT_NEAR(across / power, column, 1e-5);
    EXPECT_NEAR(down / power, row, 1e-5);
    EXPECT_LE(touched, 4);
  }
}

TEST(PowerBins, CentreOfABinIsItsOwn) {
  PowerBins bins(4, 4);
  bins.add_shared(1.5, 2.5, all(1.0F));
  EXPECT_EQ(bins.sum(1, 2), all(1.0F));
}

TEST(PowerBins, WhatFallsOutsideIsLeftOut) {
  PowerBins bins(4, 4);
  bins.add_shared(0.0, 2.5, all(1.0F));  // half over the left edge
  EXPECT_NEAR(bins.total()[0], 0.5, 1e-6);
  bins.add_shared(4.6, 1.0, all(1.0F));
  bins.add_shared(1.0, -3.0, all(1.0F));
  bins.add_shared(-1e12, 1e12, all(1.0F));
  EXPECT_NEAR(bins.total()[0], 0.5, 1e-6);
  EXPECT_EQ(bins.overflows(), 0U);
}

TEST(PowerBins, OverflowIsCountedAndLeftOut) {
  PowerBins bins(1, 1);
  bins.add(0, 0, {1e7F, 0.0F, 0.0F, 0.0F});
  EXPECT_EQ(bins.overflows(), 0U);
  bins.add(0, 0, {1e9F, 0.0F, 0.0F, 0.0F});
  EXPECT_EQ(bins.overflows(), 1U);
  EXPECT_EQ(bins.sum(0, 0).vv, 1e7F);
  bins.add(0, 0, {0.0F, std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(), -1e9F});
  EXPECT_EQ(bins.overflows(), 4U);
  EXPECT_EQ(bins.sum(0, 0).hh, 0.0F);
}

TEST(PowerBins, OverflowOfTheSumIsCounted) {
  PowerBins bins(1, 1);
  for (int i = 0; i < 20; ++i) bins.add(0, 0, {5e7F, 0.0F, 0.0F, -5e7F});
  EXPECT_GT(bins.overflows(), 0U);
  EXPECT_GT(bins.sum(0, 0).vv, 0.0F) << "the sum wrapped around";
  EXPECT_LT(bins.sum(0, 0).re_vvhh, 0.0F) << "the sum wrapped around";
}

TEST(PowerBins, HoldsWeakEchoesBesideStrongOnes) {
  PowerBins bins(1, 1);
  bins.add(0, 0, all(1e4F));
  for (int i = 0; i < 100'000; ++i) bins.add(0, 0, all(1e-5F));
  EXPECT_NEAR(bins.total()[0], 10'001.0, 1e-3);
}

// Ground in the side lobes of a pattern, water in cells of centimetres: each echo below what a unit holds.
TEST(PowerBins, EchoesOfASmallPartOfAUnitAddUp) {
  for (const float rcs_m2 : {1e-9F, 1e-12F, -3e-13F, 1e-15F}) {
    PowerBins bins(2, 2), columns(1, 4);
    PowerLine line(4);
    double sum = 0.0;
    for (int i = 0; i < 10'000; ++i) {
      const float varied = rcs_m2 * (1.0F + 1e-4F * static_cast<float>(i));
      bins.add_shared(1.0 + 1e-5 * i, 1.0, all(varied));
      line.add_shared(1.0 + 1e-5 * i, all(varied));
      sum += static_cast<double>(varied);
    }
    columns.add_column(0, line);
    EXPECT_NEAR(bins.total()[0] / sum, 1.0, 1e-5) << rcs_m2;
    EXPECT_NEAR(columns.total()[0] / sum, 1.0, 1e-5) << rcs_m2;
  }
}

TEST(PowerBins, SmallPartsDoNotDependOnOrderEither) {
  PowerBins forwards(1, 1), backwards(1, 1);
  const auto part = [](int i) { return all(1e-11F * static_cast<float>(std::sin(0.7 * i)) + 1e-13F); };
  for (int i = 0; i < 1000; ++i) {
    forwards.add(0, 0, part(i));
    backwards.add(0, 0, part(999 - i));
  }
  EXPECT_EQ(forwards.total(), backwards.total());
}

TEST(PowerBins, ForgetsWhatItIsToldToForget) {
  PowerBins bins(2, 3);
  bins.add_shared(1.0, 2.0, all(3.0F));
  bins.add(0, 0, all(1e30F));
  EXPECT_GT(bins.overflows(), 0U);
  bins.clear();
  EXPECT_EQ(bins.overflows(), 0U);
  EXPECT_EQ(bins.total(), PowerBins(2, 3).total());
}

}  // namespace
}  // namespace sigmascape::receiver
