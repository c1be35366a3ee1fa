#include "sigmascape/bake/noise_sharing.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <gtest/gtest.h>

#include "sigmascape/base/hash.h"

namespace sigmascape::bake {
namespace {

constexpr std::size_t side = 24;

double texel_power(const NoisyTexels& texels, std::size_t column, std::size_t row) {
  return static_cast<double>(texels.power(column, row).power(radar::Polarization::Sum));
}

double relative_error(const NoisyTexels& texels, std::size_t column, std::size_t row) {
  return std::sqrt(texels.variance(column, row)) / texel_power(texels, column, row);
}

/// All texels of one sure power.
NoisyTexels evenly_lit(float power) {
  return {Array2D<radar::Channels>(side, side, {power, 0.0F, 0.0F, 0.0F}), Array2D<double>(side, side)};
}

void put(NoisyTexels& texels, std::size_t column, std::size_t row, float power, double standard_error) {
  texels.power(column, row) = {power, 0.0F, 0.0F, 0.0F};
  texels.variance(column, row) = standard_error * standard_error;
}

/// A third dark, the rest of all powers and errors up to their power and beyond.
NoisyTexels random_texels() {
  NoisyTexels texels = evenly_lit(0.0F);
  for (std::size_t i = 0; i < texels.power.size(); ++i) {
    const auto lot = [&](std::uint32_t number) { return unit_float(hashed(5, static_cast<std::uint32_t>(i), number)); };
    if (lot(0) < 0.33F) continue;
    const float x = std::pow(10.0F, 4.0F * lot(1) - 2.0F);
    texels.power.values()[i] = {x, x * lot(2), x * lot(3), x * (2.0F * lot(4) - 1.0F)};
    const double total = static_cast<double>(texels.power.values()[i].power(radar::Polarization::Sum));
    texels.variance.values()[i] = std::pow(total * 1.2 * static_cast<double>(lot(5)), 2.0);
  }
  return texels;
}

std::array<double, radar::Channels::count> channel_sums(const NoisyTexels& texels) {
  std::array<double, radar::Channels::count> sum{};
  for (const radar::Channels& texel : texels.power.values()) {
    sum[0] += static_cast<double>(texel.vv);
    sum[1] += static_cast<double>(texel.hh);
    sum[2] += static_cast<double>(texel.hv);
    sum[3] += static_cast<double>(texel.re_vvhh);
  }
  return sum;
}

TEST(NoiseSharing, WhatIsSureStaysAsItIs) {
  NoisyTexels texels = random_texels();
  std::ranges::fill(texels.variance.values(), 0.0);
  const NoisyTexels shared = with_noise_shared(texels, 1);
  EXPECT_TRUE(std::ranges::equal(shared.power.values(), texels.power.values()));
  EXPECT_TRUE(std::ranges::equal(shared.variance.values(), texels.variance.values()));
}

TEST(NoiseSharing, PowerIsKeptChannelByChannel) {
  const NoisyTexels texels = random_texels();
  const auto before = channel_sums(texels), after = channel_sums(with_noise_shared(texels, 1));
  for (std::size_t channel = 0; channel < before.size(); ++channel)
    EXPECT_NEAR(after[channel] / before[channel], 1.0, 1e-5) << channel;
}

// A quarter of the variance of its power is that of its noise: three quarters of the power are sure. In the middle of
// what is lit everywhere a neighbour k columns and l rows away gets b_k b_l / 256 of the rest.
TEST(NoiseSharing, WhatIsInDoubtGoesAround) {
  NoisyTexels texels = evenly_lit(1e-3F);
  put(texels, 12, 12, 1024.0F, 512.0);
  const NoisyTexels shared = with_noise_shared(texels, 1);
  EXPECT_NEAR(texel_power(shared, 12, 12), 768.0 + 256.0 * 36.0 / 256.0, 1e-2);
  EXPECT_NEAR(texel_power(shared, 13, 12), 24.0, 1e-2);
  EXPECT_NEAR(texel_power(shared, 13, 11), 16.0, 1e-2);
  EXPECT_NEAR(texel_power(shared, 10, 12), 6.0, 1e-2);
  EXPECT_NEAR(texel_power(shared, 14, 14), 1.0, 2e-3);
  EXPECT_NEAR(texel_power(shared, 15, 12), 1e-3, 1e-6);
}

// What no second ray has confirmed is all in doubt, and no more than all.
TEST(NoiseSharing, NoMoreIsGivenThanThereIs) {
  NoisyTexels texels = evenly_lit(1e-3F);
  put(texels, 12, 12, 256.0F, 1000.0);
  EXPECT_NEAR(texel_power(with_noise_shared(texels, 1), 12, 12), 36.0, 1e-2);
}

// Of eight neighbours in a row with what is lit, those beyond its edge have fewer lit ones about them and get less.
TEST(NoiseSharing, DarkGroundGetsLess) {
  NoisyTexels texels = evenly_lit(0.0F);
  for (std::size_t row = 0; row < side; ++row) {
    for (std::size_t column = 0; column <= 12; ++column) put(texels, column, row, 1e-3F, 0.0);
  }
  put(texels, 12, 12, 100.0F, 100.0);
  const NoisyTexels shared = with_noise_shared(texels, 1);
  // Lit around: all nine at column 11, six at 12, three at 13, none at 14.
  EXPECT_NEAR(texel_power(shared, 11, 12) / texel_power(shared, 13, 12), 3.0, 1e-3);
  EXPECT_GT(texel_power(shared, 13, 12), 1.0);
  EXPECT_EQ(texel_power(shared, 14, 12), 0.0);
}

TEST(NoiseSharing, APatchsEdgeKeepsItsPower) {
  NoisyTexels texels = evenly_lit(1e-3F);
  put(texels, 0, side - 1, 64.0F, 64.0);
  const NoisyTexels shared = with_noise_shared(texels, 1);
  EXPECT_NEAR(channel_sums(shared)[0] / channel_sums(texels)[0], 1.0, 1e-6);
  // Mirrored at the rim, the weights from there on are 6 + 4, 4 + 1 and 1.
  EXPECT_NEAR(texel_power(shared, 0, side - 1), 64.0 * 100.0 / 256.0, 1e-2);
  EXPECT_NEAR(texel_power(shared, 1, side - 1), 64.0 * 50.0 / 256.0, 1e-2);
  EXPECT_NEAR(texel_power(shared, 1, side - 2), 64.0 * 25.0 / 256.0, 1e-2);
  EXPECT_NEAR(texel_power(shared, 2, side - 1), 64.0 * 10.0 / 256.0, 1e-2);
}

// No line of dark texels runs along the rim, which neighbouring patches would show as a seam.
TEST(NoiseSharing, EvenlyLitGroundStaysEvenUpToTheRim) {
  for (const double part_in_doubt : {0.25, 1.0}) {
    NoisyTexels texels = evenly_lit(2.0F);
    std::ranges::fill(texels.variance.values(), 4.0 * part_in_doubt);
    const NoisyTexels shared = with_noise_shared(texels, 1);
    for (const radar::Channels& texel : shared.power.values()) ASSERT_NEAR(texel.vv, 2.0F, 1e-5F) << part_in_doubt;
  }
}

// Neither a texel that has given away what was in doubt nor one that got it is sure of the rest.
TEST(NoiseSharing, NobodyIsSurerForIt) {
  NoisyTexels texels = evenly_lit(1e-3F);
  put(texels, 12, 12, 1024.0F, 512.0);
  const NoisyTexels shared = with_noise_shared(texels, 1);
  EXPECT_NEAR(relative_error(shared, 12, 12), 0.5, 1e-3);
  EXPECT_NEAR(relative_error(shared, 13, 12), 0.5, 1e-3);
  EXPECT_EQ(shared.variance(20, 20), 0.0);
}

// What single paths have brought to all of many alike is near the mean in the end, but none of them knows.
TEST(NoiseSharing, WhatNoSecondRayConfirmsStaysUnsure) {
  NoisyTexels texels = evenly_lit(1.0F);
  std::ranges::fill(texels.variance.values(), 1.0);
  const NoisyTexels shared = with_noise_shared(texels, 1);
  EXPECT_NEAR(texel_power(shared, 12, 12), 1.0, 1e-6);
  EXPECT_NEAR(relative_error(shared, 12, 12), 1.0, 1e-6);
}

// Sixteen alike about one: their errors are independent and what it gets of them is surer than each.
TEST(NoiseSharing, WhatManyGaveIsSurer) {
  NoisyTexels texels = evenly_lit(1.0F);
  std::ranges::fill(texels.variance.values(), 1.0);
  put(texels, 12, 12, 1.0F, 0.0);
  const NoisyTexels shared = with_noise_shared(texels, 1);
  // Σ b² / 256² but for its own share: (70² − 36²) / 256², of a power of 1 + (1 − 36 / 256).
  EXPECT_NEAR(shared.variance(12, 12), (70.0 * 70.0 - 36.0 * 36.0) / (256.0 * 256.0), 1e-6);
  EXPECT_NEAR(texel_power(shared, 12, 12), 2.0 - 36.0 / 256.0, 1e-6);
}

TEST(NoiseSharing, ThreadsChangeNothing) {
  const NoisyTexels texels = random_texels();
  const NoisyTexels one = with_noise_shared(texels, 1), four = with_noise_shared(texels, 4);
  EXPECT_TRUE(std::ranges::equal(one.power.values(), four.power.values()));
  EXPECT_TRUE(std::ranges::equal(one.variance.values(), four.variance.values()));
}

}  // namespace
}  // namespace sigmascape::bake
