#include "sigmascape/product/level_errors.h"

#include <cmath>
#include <gtest/gtest.h>
#include <limits>

#include "unit/product/made_up_map.h"

#include "sigmascape/base/error.h"
#include "sigmascape/base/hash.h"
#include "sigmascape/base/units.h"

namespace sigmascape::product {
namespace {

using radar::GroundMap;

constexpr double endless = std::numeric_limits<double>::infinity();
constexpr CompareOptions vv{.polarization = radar::Polarization::VV};

/// Columns of −40, −30, −20, −10 dB, and how much more of each.
GroundMap steps(double first_db, double second_db, double third_db, double fourth_db) {
  const double more_db[] = {first_db, second_db, third_db, fourth_db};
  return map_of(4, 2, [&](auto c, auto) { return linear_from_db(-40.0 + 10.0 * static_cast<double>(c) + more_db[c]); });
}

TEST(LevelErrors, EveryCellCountsInTheRangeOfItsTrueLevel) {
  const auto ranges = errors_by_level(steps(4, -3, 2, -1), steps(0, 0, 0, 0), {-35.0, -15.0}, 2.0, vv);
  ASSERT_EQ(ranges.size(), 3U);
  EXPECT_EQ(ranges[0].from_db, -endless);
  EXPECT_EQ(ranges[0].to_db, -35.0);
  EXPECT_EQ(ranges[1].from_db, -35.0);
  EXPECT_EQ(ranges[2].from_db, -15.0);
  EXPECT_EQ(ranges[2].to_db, endless);
  EXPECT_EQ(ranges[0].cells, 2U);
  EXPECT_EQ(ranges[1].cells, 4U);
  EXPECT_EQ(ranges[2].cells, 2U);
  EXPECT_NEAR(ranges[0].squared_error_db2, 2 * 16.0, 1e-3);
  EXPECT_NEAR(ranges[1].squared_error_db2, 2 * (9.0 + 4.0), 1e-3);
  EXPECT_NEAR(ranges[2].squared_error_db2, 2 * 1.0, 1e-3);
}

TEST(LevelErrors, TheFloorHoldsForErrorsAndLevels) {
  const auto ranges = errors_by_level(steps(-60, 0, 0, 0), steps(-20, 0, 0, 0), {-45.0}, 2.0, vv);
  EXPECT_EQ(ranges[0].cells, 0U) << "nothing lies below the floor";
  EXPECT_NEAR(ranges[1].squared_error_db2, 0.0, 1e-9);
}

TEST(LevelErrors, LevelsMayComeFromAThirdMap) {
  const auto ranges = errors_by_level(steps(2, 0, 0, 0), steps(0, 0, 0, 0), steps(30, 0, 0, 0), {-15.0}, 2.0, vv);
  EXPECT_EQ(ranges[0].cells, 4U);
  EXPECT_EQ(ranges[1].cells, 4U);
  EXPECT_NEAR(ranges[0].squared_error_db2, 0.0, 1e-9);
  EXPECT_NEAR(ranges[1].squared_error_db2, 2 * 4.0, 1e-3);
}

TEST(LevelErrors, TogetherTheyAreTheSquaredErrorOfTheMap) {
  const auto rough = [](std::uint64_t stream) {
    return map_of(64, 64, [=](auto c, auto r) {
      return linear_from_db(-50.0 + 50.0 * static_cast<double>(unit_float(hashed(stream, c, r))));
    });
  };
  GroundMap tested = rough(1);
  const GroundMap truth = rough(2);
  tested.sigma0(5, 5).vv = unseen_power;
  for (const double cell_m : {2.0, 8.0}) {
    CompareOptions at_cell = vv;
    at_cell.cells_m = {cell_m};
    const CellComparison whole = compare_maps(tested, truth, at_cell).at.front();
    std::size_t cells = 0;
    double squared_error_db2 = 0.0;
    for (const LevelError& range : errors_by_level(tested, truth, {-30.0, -15.0}, cell_m, vv)) {
      cells += range.cells;
      squared_error_db2 += range.squared_error_db2;
    }
    EXPECT_EQ(cells, whole.cells);
    EXPECT_NEAR(std::sqrt(squared_error_db2 / static_cast<double>(cells)), whole.rms_db, 1e-9);
  }
}

TEST(LevelErrors, MapsAndCellsThatDoNotFitAreRefused) {
  const GroundMap map = steps(0, 0, 0, 0), smaller = map_of(2, 2, [](auto, auto) { return 1.0; });
  EXPECT_THROW((void)errors_by_level(map, smaller, {-30.0}, 2.0), Error);
  EXPECT_THROW((void)errors_by_level(map, map, {-30.0}, 3.0), Error);
}

}  // namespace
}  // namespace sigmascape::product
