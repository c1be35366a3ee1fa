#include "sigmascape/product/noise_free_metrics.h"

#include <cmath>
#include <gtest/gtest.h>

#include "unit/product/made_up_map.h"

#include "sigmascape/base/error.h"
#include "sigmascape/base/hash.h"
#include "sigmascape/base/units.h"

namespace sigmascape::product {
namespace {

using radar::GroundMap;

constexpr std::size_t side = 200;
constexpr CompareOptions deep_vv{.polarization = radar::Polarization::VV, .floor_db = -100.0};

/// Even over ±1; streams that differ have nothing to do with one another.
double even(std::uint64_t stream, std::size_t column, std::size_t row) {
  return 2.0 * static_cast<double>(unit_float(hashed(stream, column, row))) - 1.0;
}

TEST(NoiseFreeMetrics, WithoutNoiseTheyAreThePlainMetrics) {
  const GroundMap truth = map_of(side, side, [](auto c, auto r) { return linear_from_db(10.0 * even(1, c, r)); });
  const GroundMap tested = map_of(
      side, side, [](auto c, auto r) { return linear_from_db(1.0 + 10.0 * even(1, c, r) + 6.0 * even(2, c, r)); });
  for (const double cell_m : {2.0, 8.0}) {
    CompareOptions at_cell = deep_vv;
    at_cell.cells_m = {cell_m};
    const CellComparison plain = compare_maps(tested, truth, at_cell).at.front();
    const NoiseFreeComparison noise_free = compare_without_noise({tested, tested}, {truth, truth}, cell_m, deep_vv);
    EXPECT_EQ(noise_free.cells, plain.cells);
    EXPECT_NEAR(noise_free.correlation_db, plain.correlation_db, 1e-9);
    EXPECT_NEAR(noise_free.rms_db, plain.rms_db, 1e-9);
  }
}

/// A scene of levels even over 30 dB, seen with `noise_db` of even noise.
GroundMap noisy(std::uint64_t stream, double noise_db, double fault_db = 0.0) {
  return map_of(side, side, [=](auto c, auto r) {
    return linear_from_db(-15.0 + 15.0 * even(1, c, r) + fault_db * even(2, c, r) + noise_db * even(stream, c, r));
  });
}

TEST(NoiseFreeMetrics, NoiseInDecibelsIsTakenOutWhole) {
  // Variance of an even spread of ±w is w²/3.
  constexpr double fault_db = 5.0, tested_noise_db = 12.0, true_noise_db = 8.0;
  const GroundMap a1 = noisy(11, tested_noise_db, fault_db), a2 = noisy(12, tested_noise_db, fault_db);
  const GroundMap b1 = noisy(21, true_noise_db), b2 = noisy(22, true_noise_db);
  CompareOptions at_cell = deep_vv;
  at_cell.cells_m = {2.0};
  const CellComparison measured = compare_maps(a1, b1, at_cell).at.front();
  EXPECT_LT(measured.correlation_db, 0.75);
  EXPECT_GT(measured.rms_db, 8.0);
  const NoiseFreeComparison noise_free = compare_without_noise({a1, a2}, {b1, b2}, 2.0, deep_vv);
  EXPECT_NEAR(noise_free.correlation_db, 15.0 / std::hypot(15.0, fault_db), 0.01);
  EXPECT_NEAR(noise_free.rms_db, fault_db / std::sqrt(3.0), 0.1);
}

/// A cell's power as rays find it: an even share that all bring, and rare bright echoes, many or few, that make up most
/// of dark cells. Its expectation is the ground's own power.
double traced(std::uint64_t stream, std::size_t column, std::size_t row, double expected) {
  constexpr unsigned rays = 256;
  constexpr double chance = 0.02, even_share = 0.3;
  const std::uint64_t cell = hashed(stream, column, row);
  double sum = 0.0;
  for (unsigned ray = 0; ray < rays; ++ray) {
    const double draw = static_cast<double>(unit_float(hashed(cell, ray)));
    if (draw >= chance) continue;
    // The square of an exponential variable has a mean of 2 and a long tail.
    const double exponential = -std::log(1.0 - draw / chance);
    sum += exponential * exponential / 2.0;
  }
  return expected * (even_share + (1.0 - even_share) * sum / (chance * rays));
}

TEST(NoiseFreeMetrics, MapsOfOneSceneFromAsManyRaysAgreeHoweverFewEchoesTheyGot) {
  const auto map = [](std::uint64_t stream, double fault_db) {
    return map_of(160, 160, [=](auto c, auto r) {
      return traced(stream, c, r,
                    linear_from_db(-20.0 + 8.0 * even(1, c / 4, r / 4) + fault_db * even(2, c / 4, r / 4)));
    });
  };
  const CompareOptions options{.cells_m = {4.0}, .polarization = radar::Polarization::VV};
  const GroundMap b1 = map(21, 0.0), b2 = map(22, 0.0);
  {
    const GroundMap a1 = map(11, 0.0), a2 = map(12, 0.0);
    EXPECT_LT(compare_maps(a1, b1, options).at.front().correlation_db, 0.96);
    const NoiseFreeComparison faultless = compare_without_noise({a1, a2}, {b1, b2}, 4.0, options);
    EXPECT_NEAR(faultless.correlation_db, 1.0, 0.003);
    EXPECT_LT(faultless.rms_db, 0.3);
  }
  const GroundMap a1 = map(11, 3.0), a2 = map(12, 3.0);
  const NoiseFreeComparison faulty = compare_without_noise({a1, a2}, {b1, b2}, 4.0, options);
  EXPECT_NEAR(faulty.correlation_db, 8.0 / std::hypot(8.0, 3.0), 0.01);
  EXPECT_NEAR(faulty.rms_db, 3.0 / std::sqrt(3.0), 0.1);
}

TEST(NoiseFreeMetrics, WithoutACellThatAllSawNothingIsSaid) {
  const GroundMap map = map_of(4, 4, [](auto, auto) { return 1.0; });
  const GroundMap blind = map_of(4, 4, [](auto, auto) { return static_cast<double>(unseen_power); });
  EXPECT_THROW(static_cast<void>(compare_without_noise({map, blind}, {map, map}, 2.0, deep_vv)), Error);
}

TEST(NoiseFreeMetrics, NoiseAloneHasNoCorrelationToSpeakOf) {
  const auto noise = [](std::uint64_t stream) {
    return map_of(4, 4, [=](auto c, auto r) { return linear_from_db(10.0 * even(stream, c, r)); });
  };
  const GroundMap flat = map_of(4, 4, [](auto, auto) { return 1.0; });
  const GroundMap b1 = noise(1), b2 = noise(2);
  EXPECT_TRUE(std::isnan(compare_without_noise({flat, flat}, {b1, b2}, 2.0, deep_vv).correlation_db));
}

TEST(NoiseFreeMetrics, CellsThatOneOfTheFourDidNotSeeAreLeftOut) {
  const GroundMap map = noisy(11, 3.0);
  GroundMap partly = map;
  partly.sigma0(0, 0).vv = unseen_power;
  EXPECT_EQ(compare_without_noise({map, partly}, {map, map}, 2.0, deep_vv).cells, side * side - 1);
  EXPECT_EQ(compare_without_noise({map, map}, {map, partly}, 8.0, deep_vv).cells, side * side / 16 - 1);
}

TEST(NoiseFreeMetrics, MapsAndCellsThatDoNotFitAreRefused) {
  const GroundMap map = noisy(11, 3.0), smaller = map_of(4, 4, [](auto, auto) { return 1.0; });
  EXPECT_THROW((void)compare_without_noise({map, smaller}, {map, map}, 2.0), Error);
  EXPECT_THROW((void)compare_without_noise({map, map}, {map, map}, 3.0), Error);
}

}  // namespace
}  // namespace sigmascape::product
