#include "sigmascape/receiver/ground_accumulator.h"

#include <cmath>
#include <gtest/gtest.h>

namespace sigmascape::receiver {
namespace {

constexpr radar::GroundGrid half_metre_cells{
    .west_m = -50.0, .north_m = 50.0, .cell_m = 0.5, .columns = 200, .rows = 100};

TEST(GroundAccumulator, CellsAreNumberedRowByRowFromTheNorthWest) {
  const GroundAccumulator accumulator(half_metre_cells);
  for (const auto& [column, row] : {std::pair{0, 0}, {199, 0}, {17, 42}, {0, 99}, {199, 99}}) {
    const auto c = static_cast<std::size_t>(column), r = static_cast<std::size_t>(row);
    EXPECT_EQ(accumulator.cell_at(half_metre_cells.centre_of(c, r)), r * 200 + c);
  }
}

TEST(GroundAccumulator, WhatStandsOutsideHasNoCell) {
  const GroundAccumulator accumulator(half_metre_cells);
  for (const Vec2d point : {Vec2d{0, 50.01}, {0, -0.01}, {-50.01, 25}, {50.01, 25}, {0, 1e12}, {-1e12, 0}})
    EXPECT_FALSE(accumulator.cell_at(point)) << point.x << " " << point.y;
}

TEST(GroundAccumulator, SigmaIsCrossSectionOverCellArea) {
  GroundAccumulator accumulator(half_metre_cells);
  const auto cell = accumulator.cell_at({0.25, 0.25}).value();
  accumulator.add(cell, {3.0F, 1.0F, 0.5F, -2.0F}, 0.0);
  accumulator.add(cell, {2.0F, 1.0F, 0.5F, 1.0F}, 0.0);
  const radar::Channels sigma0 = accumulator.sigma0()(100, 99);
  EXPECT_FLOAT_EQ(sigma0.vv, 20.0F);
  EXPECT_FLOAT_EQ(sigma0.hh, 8.0F);
  EXPECT_FLOAT_EQ(sigma0.hv, 4.0F);
  EXPECT_FLOAT_EQ(sigma0.re_vvhh, -4.0F);
  EXPECT_DOUBLE_EQ(accumulator.bins().total()[0], 5.0);
}

// Independent parts: their variances add up, and go with the square of the area that σ0 is taken over.
TEST(GroundAccumulator, VariancesOfPartsAddUp) {
  GroundAccumulator accumulator(half_metre_cells);
  accumulator.add(7, {1.0F, 2.0F, 0.5F, 0.0F}, 0.36);
  accumulator.add(7, {2.0F, 1.0F, 0.5F, 0.0F}, 0.28);
  EXPECT_NEAR(accumulator.sigma0_variances()(7, 0), 0.64 / (0.25 * 0.25), 1e-8);
  EXPECT_EQ(accumulator.sigma0_variances()(8, 0), 0.0);
}

// Parts of every size, thousands of them, as one corner of walls sends into a texel.
TEST(GroundAccumulator, VariancesOfManyPartsOfAnySizeAddUp) {
  for (const double deviation_m2 : {1e-7, 1e-5, 1e-3, 0.1, 3.9, 31.0, 1e3, 1e4}) {
    GroundAccumulator accumulator(half_metre_cells);
    constexpr int parts = 5000;
    for (int i = 0; i < parts; ++i)
      accumulator.add(7, {static_cast<float>(deviation_m2), 0.0F, 0.0F, 0.0F}, deviation_m2 * deviation_m2);
    const double expected = parts * deviation_m2 * deviation_m2 / (0.25 * 0.25);
    EXPECT_NEAR(accumulator.sigma0_variances()(7, 0), expected, 0.01 * expected) << deviation_m2;
  }
  // What is smaller than what sums tell is at least not said to be nothing.
  GroundAccumulator darkest(half_metre_cells);
  for (int i = 0; i < 100; ++i) darkest.add(7, {1e-9F, 0.0F, 0.0F, 0.0F}, 1e-20);
  EXPECT_GE(darkest.sigma0_variances()(7, 0), 100.0 * 1e-20 * 16.0);
  // The brightest that powers hold: four parts of VV + HH + 2 HV = 2²⁶ m², each from one sample alone.
  GroundAccumulator brightest(half_metre_cells);
  for (int i = 0; i < 4; ++i) {
    constexpr float part_m2 = 0.999F * 0x1p24F;
    brightest.add(7, {part_m2, part_m2, part_m2, 0.0F}, std::exp2(52.0));
  }
  EXPECT_NEAR(brightest.sigma0_variances()(7, 0) / (4.0 * std::exp2(52.0) * 16.0), 1.0, 1e-6);
}

// One sample of many found it: what it may be is not more than once what it is.
TEST(GroundAccumulator, DeviationsAreNoLargerThanThePower) {
  for (const float power_m2 : {1e-8F, 1e-12F, 1e-18F}) {
    GroundAccumulator accumulator(half_metre_cells);
    const auto deviation_m2 = static_cast<double>(power_m2);
    accumulator.add(7, {power_m2, 0.0F, 0.0F, 0.0F}, deviation_m2 * deviation_m2);
    const auto power = static_cast<double>(accumulator.sigma0()(7, 0).vv);
    EXPECT_NEAR(std::sqrt(accumulator.sigma0_variances()(7, 0)), power, 0.1 * power) << power_m2;
  }
}

}  // namespace
}  // namespace sigmascape::receiver
