#include "sigmascape/bake/cell_sum.h"

#include <algorithm>
#include <cstdint>
#include <gtest/gtest.h>
#include <vector>

#include "sigmascape/base/hash.h"

namespace sigmascape::bake {
namespace {

/// One row of texels of a square metre, so that σ0 is the cross-section.
PatchSums row_of(std::size_t texels) {
  return {
      .all = receiver::GroundAccumulator({.west_m = 0.0, .north_m = 1.0, .cell_m = 1.0, .columns = texels, .rows = 1}),
      .several = std::nullopt};
}

Landed landed(std::uint32_t sample, float power_m2, std::uint32_t texel = 0) {
  return {.texel = texel, .sample = sample, .several = false, .rcs_m2 = {power_m2, 0.0F, 0.0F, 0.0F}};
}

struct Stated {
  double power = 0.0, variance = 0.0;
};

Stated sum_of(std::vector<Landed> echoes, std::uint32_t samples) {
  PatchSums patch = row_of(1);
  CellSum().add(echoes, SamplePairs(samples), patch);
  return {static_cast<double>(patch.all.sigma0()(0, 0).vv), patch.all.sigma0_variances()(0, 0)};
}

TEST(CellSum, HasTheSquaredDifferencesOfPairsForItsVariance) {
  // Four samples: 0 and 2 lie beside one another, and 1 and 3.
  ASSERT_EQ(SamplePairs(4).beside(0), 2U);
  const Stated sum = sum_of({landed(0, 3.0F), landed(2, 1.0F), landed(2, 0.5F), landed(3, 2.0F)}, 4);
  EXPECT_NEAR(sum.power, 6.5 / 4.0, 1e-6);
  EXPECT_NEAR(sum.variance, (1.5 * 1.5 + 2.0 * 2.0) / 16.0, 1e-6);
}

TEST(CellSum, HoldsTheLastOfAnOddNumberAgainstTheFirst) {
  const double variance = (2.0 * 2.0 + 0.5 * 5.0 * 5.0) / 9.0;
  EXPECT_NEAR(sum_of({landed(0, 5.0F), landed(1, 3.0F)}, 3).variance, variance, 1e-6);
  EXPECT_NEAR(sum_of({landed(0, 1.0F), landed(1, 3.0F), landed(2, 6.0F)}, 3).variance, variance, 1e-6);
}

TEST(CellSum, IsSureOfWhatEverySampleBringsAlike) {
  std::vector<Landed> echoes;
  for (std::uint32_t sample = 0; sample < 100; ++sample) echoes.push_back(landed(sample, 0.37F));
  EXPECT_EQ(sum_of(echoes, 100).variance, 0.0);
}

TEST(CellSum, TexelsOfACellAreApart) {
  std::vector<Landed> echoes = {landed(1, 2.0F, 1), landed(0, 1.0F, 0), landed(1, 1.0F, 0)};
  PatchSums patch = row_of(2);
  CellSum sum;
  sum.add(echoes, SamplePairs(2), patch);
  EXPECT_NEAR(patch.all.sigma0_variances()(0, 0), 0.0, 1e-6);
  EXPECT_NEAR(patch.all.sigma0_variances()(1, 0), 1.0, 1e-6);
}

// Of a building that is kept apart they are summed up by themselves, where that is asked for.
TEST(CellSum, WhatIsKeptApartIsSummedUpByItself) {
  std::vector<Landed> echoes = {landed(0, 1.0F), landed(0, 5.0F), landed(1, 2.0F), landed(1, 7.0F)};
  echoes[1].apart = echoes[3].apart = true;
  PatchSums patch = row_of(1);
  patch.buildings = row_of(1).all;
  CellSum().add(echoes, SamplePairs(2), patch);
  EXPECT_NEAR(patch.all.sigma0()(0, 0).vv, 1.5F, 1e-6F);
  EXPECT_NEAR(patch.buildings->sigma0()(0, 0).vv, 6.0F, 1e-6F);
  EXPECT_NEAR(patch.all.sigma0_variances()(0, 0), 0.25, 1e-6);
  EXPECT_NEAR(patch.buildings->sigma0_variances()(0, 0), 1.0, 1e-6);
}

TEST(CellSum, StatesTheVarianceOfSamplesThatAreIndependent) {
  // Of rare echoes, one sample in ten brings something, of an even and of an odd number.
  for (const std::uint32_t samples : {16U, 21U}) {
    constexpr std::uint64_t cells = 4000;
    double stated = 0.0, sum = 0.0, squares = 0.0;
    for (std::uint64_t cell = 0; cell < cells; ++cell) {
      std::vector<Landed> echoes;
      for (std::uint32_t sample = 0; sample < samples; ++sample) {
        const float size = unit_float(hashed(cell, sample, 1U));
        if (unit_float(hashed(cell, sample, 0U)) < 0.1F) echoes.push_back(landed(sample, 1.0F + size));
      }
      if (echoes.empty()) continue;
      const Stated one = sum_of(echoes, samples);
      stated += one.variance / cells;
      sum += one.power / cells;
      squares += one.power * one.power / cells;
    }
    // The variance of a variance from 4000 such cells is some 4 %.
    EXPECT_NEAR(stated / (squares - sum * sum), 1.0, 0.12) << samples << " samples";
  }
}

TEST(CellSum, AddsUpAMillionSamples) {
  std::vector<Landed> echoes;
  constexpr std::uint32_t samples = 1U << 20U;
  for (std::uint32_t sample = 0; sample < samples; ++sample) echoes.push_back(landed(sample, 0.0158F));
  EXPECT_NEAR(sum_of(echoes, samples).power, 0.0158, 1e-7);
}

}  // namespace
}  // namespace sigmascape::bake
