#include "sigmascape/simulate/lattice_sums.h"

#include <gtest/gtest.h>
#include <span>
#include <vector>

namespace sigmascape::simulate {
namespace {

struct Held {
  radar::LatticeCell cell;
  LatticeSums::Sum sum;
};

/// The cells that hold power, in the order in which they are told.
std::vector<Held> held(const LatticeSums& sums, double scale = 1.0) {
  std::vector<Held> cells;
  sums.for_each_run(scale, [&](radar::LatticeCell first, std::span<const LatticeSums::Sum> run) {
    for (std::size_t i = 0; i < run.size(); ++i) {
      if (run[i].rcs_m2 != radar::Channels{})
        cells.push_back({{first.column + static_cast<std::int32_t>(i), first.row}, run[i]});
    }
  });
  return cells;
}

// A mirror in one cell, passes without end, and a weak echo in another.
TEST(LatticeSums, HoldAnyNumberOfPassesOfABrightCell) {
  constexpr float bright_m2 = 0x1p23F, weak_m2 = 1e-3F;
  constexpr int passes = 1000;
  LatticeSums sums(1.0);
  for (int pass = 0; pass < passes; ++pass) {
    sums.add({0, 0}, radar::Channels{bright_m2, 0.0F, 0.0F, 0.0F}, {0.25, -0.5});
    sums.add({1, 0}, radar::Channels{weak_m2, 0.0F, 0.0F, 0.0F}, {0.0, 0.5});
    sums.make_room();
  }
  EXPECT_EQ(sums.overflows(), 0U);
  const std::vector<Held> cells = held(sums, 1.0 / passes);
  ASSERT_EQ(cells.size(), 2U);
  const LatticeSums::Sum &bright = cells[0].sum, &weak = cells[1].sum;
  EXPECT_FLOAT_EQ(bright.rcs_m2.vv, bright_m2);
  EXPECT_NEAR(bright.place.beam, 0.25, 1e-9);
  EXPECT_NEAR(bright.place.range, -0.5, 1e-9);
  EXPECT_NEAR(weak.rcs_m2.vv / weak_m2, 1.0F, 1e-5F);
  EXPECT_NEAR(weak.place.range, 0.5, 1e-5);
}

TEST(LatticeSums, CountWhatDoesNotFit) {
  LatticeSums sums(1.0);
  sums.add({0, 0}, radar::Channels{0x1p27F, 0.0F, 0.0F, 0.0F}, {});
  EXPECT_EQ(sums.overflows(), 1U);
  EXPECT_TRUE(held(sums).empty());
}

TEST(LatticeSums, TellCellsRowByRowWhereverTheyLie) {
  const std::vector<radar::LatticeCell> cells{{-40'000'000, -9}, {7, -9}, {-1, -1}, {0, -1}, {8, -1},
                                              {-1, 0},           {0, 0},  {16, 0},  {3, 1},  {0, 40'000'000}};
  LatticeSums sums(0.25);
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const std::size_t number = 7 * i % cells.size();
    sums.add(cells[number], radar::Channels{static_cast<float>(number + 1), 0.0F, 0.0F, 0.0F}, {});
  }
  const std::vector<Held> told = held(sums);
  ASSERT_EQ(told.size(), cells.size());
  for (std::size_t i = 0; i < cells.size(); ++i) {
    EXPECT_EQ(told[i].cell, cells[i]) << i;
    EXPECT_EQ(told[i].sum.rcs_m2.vv, static_cast<float>(i + 1)) << i;
  }
}

// What lies between two cells takes none.
TEST(LatticeSums, TakeMemoryWhereSomethingLands) {
  LatticeSums sums(1.0);
  EXPECT_EQ(sums.cells_held(), 0U);
  for (const std::int32_t far : {-100'000, 100'000}) sums.add({far, far}, radar::Channels{1.0F, 0.0F, 0.0F, 0.0F}, {});
  EXPECT_LE(sums.cells_held(), 2U * 256U);
}

}  // namespace
}  // namespace sigmascape::simulate
