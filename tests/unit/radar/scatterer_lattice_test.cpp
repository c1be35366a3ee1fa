#include "sigmascape/radar/scatterer_lattice.h"

#include <cmath>
#include <gtest/gtest.h>

#include "sigmascape/base/error.h"

namespace sigmascape::radar {
namespace {

constexpr LatticeOptions five_levels{.seed = 7, .cell_m = 2.0, .levels = 5};

TEST(ScattererLattice, a_cell_is_half_the_sum_of_its_four_children) {
  const ScattererLattice lattice(five_levels);
  for (int level = 1; level < 5; ++level) {
    for (const LatticeCell cell : {LatticeCell{0, 0}, {-1, -1}, {5, -7}, {-1000, 12345}}) {
      for (const Draw draw : {Draw::First, Draw::Second, Draw::Third}) {
        ComplexPair sum;
        for (const int east : {0, 1}) {
          for (const int north : {0, 1}) {
            const ComplexPair child = lattice.value_of({2 * cell.column + east, 2 * cell.row + north}, level - 1, draw);
            sum = {sum.re + child.re / 2.0F, sum.im + child.im / 2.0F};
          }
        }
        const ComplexPair parent = lattice.value_of(cell, level, draw);
        EXPECT_NEAR(sum.re, parent.re, 1e-5);
        EXPECT_NEAR(sum.im, parent.im, 1e-5);
      }
    }
  }
}

TEST(ScattererLattice, one_cell_many_cells_and_a_block_give_the_same_numbers) {
  const ScattererLattice lattice(five_levels);
  constexpr int level = 1, depth = 4, side = 1 << depth;
  const LatticeCell coarse{-2, 3};
  std::vector<std::int32_t> columns, rows;
  for (int row = 0; row < side; ++row) {
    for (int column = 0; column < side; ++column) {
      columns.push_back(coarse.column * side + column);
      rows.push_back(coarse.row * side + row);
    }
  }
  std::vector<float> re(columns.size()), im(columns.size());
  lattice.values_of(columns, rows, level, Draw::Second, re, im);
  std::vector<ComplexPair> block;
  lattice.block(coarse, level, depth, Draw::Second, block);  // begins one level above the coarsest
  ASSERT_EQ(block.size(), columns.size());
  for (std::size_t i = 0; i < columns.size(); ++i) {
    const ComplexPair one = lattice.value_of({columns[i], rows[i]}, level, Draw::Second);
    EXPECT_EQ(one.re, re[i]);
    EXPECT_EQ(one.im, im[i]);
    EXPECT_EQ(one.re, block[i].re);
    EXPECT_EQ(one.im, block[i].im);
  }
}

TEST(ScattererLattice, the_scatterer_stands_in_its_cell_and_points_find_their_cell) {
  const ScattererLattice lattice(five_levels);
  for (int level = 0; level < 5; ++level) {
    for (const LatticeCell cell : {LatticeCell{0, 0}, {-1, -1}, {300, -20}}) {
      const Vec2d place = lattice.position_in(cell, level);
      EXPECT_EQ(lattice.cell_at(place, level), cell);
    }
  }
  EXPECT_EQ(lattice.cell_at({-0.1, 3.9}, 0), (LatticeCell{-1, 1}));
}

TEST(ScattererLattice, another_seed_or_draw_gives_other_numbers) {
  const ScattererLattice lattice(five_levels), other({.seed = 8, .cell_m = 2.0, .levels = 5});
  const LatticeCell cell{3, 4};
  EXPECT_NE(lattice.value_of(cell, 0, Draw::First).re, other.value_of(cell, 0, Draw::First).re);
  EXPECT_NE(lattice.value_of(cell, 0, Draw::First).re, lattice.value_of(cell, 0, Draw::Second).re);
}

TEST(ScattererLattice, levels_above_the_tied_ones_are_drawn_cell_by_cell) {
  for (const int tied : {1, 3}) {
    const ScattererLattice lattice({.seed = 7, .cell_m = 2.0, .levels = tied});
    for (const int level : {tied - 1, tied, tied + 3}) {
      double power = 0.0, of_neighbours = 0.0;
      constexpr int side = 64;
      for (int row = 0; row < side; ++row) {
        for (int column = 0; column < side; ++column) {
          const ComplexPair value = lattice.value_of({column, row}, level, Draw::First);
          const ComplexPair next = lattice.value_of({column + 1, row}, level, Draw::First);
          power += static_cast<double>(value.re * value.re + value.im * value.im) / (side * side);
          of_neighbours += static_cast<double>(value.re * next.re + value.im * next.im) / (side * side);
        }
      }
      // Standard deviations: of the exponential density, and of a product of two independent values, over 64.
      EXPECT_NEAR(power, 1.0, 4.0 / side) << tied << " tied, level " << level;
      EXPECT_NEAR(of_neighbours, 0.0, 4.0 / side) << tied << " tied, level " << level;
    }
  }
}

TEST(ScattererLattice, refuses_a_lattice_without_cells_or_levels) {
  EXPECT_THROW(ScattererLattice({.cell_m = 0.0}), Error);
  EXPECT_THROW(ScattererLattice({.cell_m = 1.0, .levels = 0}), Error);
}

TEST(Polarized, keeps_the_power_of_every_polarization) {
  const DrawnCell unit{{1.0F, 0.0F}, {0.0F, 0.0F}, {0.0F, 1.0F}};
  const ComplexChannels amplitude = polarized(unit, {.vv = 4.0F, .hh = 9.0F, .hv = 1.0F, .re_vvhh = 6.0F});
  EXPECT_FLOAT_EQ(amplitude.vv.real(), 2.0F);
  EXPECT_FLOAT_EQ(amplitude.hh.real(), 3.0F);  // fully correlated
  EXPECT_FLOAT_EQ(amplitude.hv.imag(), 1.0F);
  const ComplexChannels dihedral = polarized(unit, {.vv = 4.0F, .hh = 9.0F, .hv = 1.0F, .re_vvhh = -6.0F});
  EXPECT_FLOAT_EQ(dihedral.hh.real(), -3.0F);
}

TEST(Polarized, without_power_there_is_no_amplitude) {
  EXPECT_EQ(polarized({{1.0F, 1.0F}, {1.0F, 1.0F}, {1.0F, 1.0F}}, {}), ComplexChannels{});
}

TEST(UnitPhasor, follows_the_phase_all_the_way_round) {
  for (int k = 0; k < 4096; ++k) {
    const std::uint32_t turns = static_cast<std::uint32_t>(k) << 20U;
    const double phase = 2.0 * 3.14159265358979323846 * k / 4096.0;
    EXPECT_NEAR(unit_phasor(turns).re, std::cos(phase), 5e-7);
    EXPECT_NEAR(unit_phasor(turns).im, std::sin(phase), 5e-7);
  }
}

TEST(NegativeLog, agrees_with_the_logarithm) {
  for (float u = 0x1p-24F; u < 1.0F; u *= 1.0371F)
    EXPECT_NEAR(negative_log(u), -std::log(u), 3e-7 * (1.0 - std::log(u)));
}

}  // namespace
}  // namespace sigmascape::radar
