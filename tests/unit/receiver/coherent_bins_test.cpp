#include "sigmascape/receiver/coherent_bins.h"

#include <gtest/gtest.h>

#include "sigmascape/base/hash.h"

namespace sigmascape::receiver {
namespace {

double total_power(const Array2D<radar::ComplexChannels>& bins) {
  double total = 0.0;
  for (const radar::ComplexChannels& bin : bins.values()) total += std::norm(bin.vv);
  return total;
}

TEST(CoherentBins, an_echo_keeps_its_power_wherever_in_a_bin_it_lies) {
  for (const double column : {4.5, 4.6, 5.0, 5.37}) {
    for (const double row : {20.5, 20.71, 21.0}) {
      CoherentBins bins(10, 40);
      const PlacedAmplitude echo{column, row, {.vv = {3.0F, -4.0F}, .hh = {}, .hv = {}}};
      bins.add({&echo, 1});
      EXPECT_NEAR(total_power(bins.sums()), 25.0, 1e-4);
    }
  }
}

TEST(CoherentBins, opposite_phases_cancel) {
  CoherentBins bins(4, 4);
  const std::vector<PlacedAmplitude> pair{{1.5, 1.5, {.vv = {1.0F, 2.0F}, .hh = {}, .hv = {}}},
                                          {1.5, 1.5, {.vv = {-1.0F, -2.0F}, .hh = {}, .hv = {}}}};
  bins.add(pair);
  EXPECT_EQ(total_power(bins.sums()), 0.0);
}

TEST(CoherentBins, sums_do_not_depend_on_the_number_of_threads) {
  std::vector<PlacedAmplitude> placed;
  for (std::uint64_t i = 0; i < 20000; ++i) {
    placed.push_back({unit_float(hashed(i, 0)) * 70.0 - 3.0,
                      unit_float(hashed(i, 1)) * 150.0 - 30.0,
                      {{unit_float(hashed(i, 2)), unit_float(hashed(i, 3))}, {1.0F, 0.0F}, {0.0F, 1.0F}}});
  }
  CoherentBins one(64, 100), many(64, 100);
  one.add(placed, 1);
  many.add(placed, 7);
  for (std::size_t i = 0; i < one.sums().size(); ++i) EXPECT_EQ(one.sums().values()[i], many.sums().values()[i]);
}

TEST(CoherentBins, leaves_out_what_lies_outside) {
  CoherentBins bins(4, 4);
  const std::vector<PlacedAmplitude> outside{{-8.0, 1.0, {.vv = {1.0F, 0.0F}, .hh = {}, .hv = {}}},
                                             {1.0, 1e9, {.vv = {1.0F, 0.0F}, .hh = {}, .hv = {}}},
                                             {1.0, std::nan(""), {.vv = {1.0F, 0.0F}, .hh = {}, .hv = {}}}};
  bins.add(outside);
  EXPECT_EQ(total_power(bins.sums()), 0.0);
}

}  // namespace
}  // namespace sigmascape::receiver
