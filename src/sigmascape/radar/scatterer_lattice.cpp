#include "sigmascape/radar/scatterer_lattice.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

#include "sigmascape/base/error.h"
#include "sigmascape/base/hash.h"
#include "sigmascape/base/vector_targets.h"

namespace sigmascape::radar {
namespace {

constexpr int most_levels = 24;
constexpr float root_half = 0.70710678F;

/// What a hashed number of a cell is for. A parent is split by one difference between its western and its eastern
/// half, and each half by one between south and north.
enum Purpose : int { Value, WestEast, WesternHalf, EasternHalf, Place };

/// One side of a split: + for the western or southern part.
ComplexPair part(ComplexPair whole, ComplexPair difference, std::int32_t far_side) {
  const auto sign = static_cast<float>(1 - 2 * far_side);
  return {(whole.re + sign * difference.re) * root_half, (whole.im + sign * difference.im) * root_half};
}

/// The keys of the three differences by which a parent is split.
struct SplitKeys {
  std::uint64_t west_east, western_half, eastern_half;
};

struct Cells {
  const std::int32_t* column;
  const std::int32_t* row;
  std::size_t count;
};

struct Values {
  float* re;
  float* im;
};

/// Values of the cells `shift` levels above the given ones.
SIGMASCAPE_VECTOR_TARGETS void draw_cells(Cells cells, int shift, std::uint64_t key, Values out) {
  for (std::size_t i = 0; i < cells.count; ++i) {
    const ComplexPair value = complex_gaussian(hashed_cell(key, cells.column[i] >> shift, cells.row[i] >> shift));
    out.re[i] = value.re;
    out.im[i] = value.im;
  }
}

/// From values of parents to those of their children, which are `shift` levels above the given cells.
SIGMASCAPE_VECTOR_TARGETS void split_cells(Cells cells, int shift, SplitKeys keys, Values values) {
  for (std::size_t i = 0; i < cells.count; ++i) {
    const std::int32_t column = cells.column[i] >> shift, row = cells.row[i] >> shift;
    const std::int32_t east = column & 1, north = row & 1;
    const ComplexPair parent{values.re[i], values.im[i]};
    const ComplexPair half = part(parent, complex_gaussian(hashed_cell(keys.west_east, column >> 1, row >> 1)), east);
    const std::uint64_t chosen =
        keys.western_half ^ ((keys.western_half ^ keys.eastern_half) & (0ULL - static_cast<std::uint64_t>(east)));
    const ComplexPair child = part(half, complex_gaussian(hashed_cell(chosen, column >> 1, row >> 1)), north);
    values.re[i] = child.re;
    values.im[i] = child.im;
  }
}

/// A row of parents into two rows of children, the southern and the northern.
SIGMASCAPE_VECTOR_TARGETS void split_row(const ComplexPair* parents, std::size_t count, LatticeCell first,
                                         SplitKeys keys, ComplexPair* south, ComplexPair* north) {
  for (std::size_t x = 0; x < count; ++x) {
    const std::int32_t column = first.column + static_cast<std::int32_t>(x);
    const ComplexPair difference = complex_gaussian(hashed_cell(keys.west_east, column, first.row));
    const ComplexPair western = complex_gaussian(hashed_cell(keys.western_half, column, first.row));
    const ComplexPair eastern = complex_gaussian(hashed_cell(keys.eastern_half, column, first.row));
    const ComplexPair west = part(parents[x], difference, 0), east = part(parents[x], difference, 1);
    south[2 * x] = part(west, western, 0);
    north[2 * x] = part(west, western, 1);
    south[2 * x + 1] = part(east, eastern, 0);
    north[2 * x + 1] = part(east, eastern, 1);
  }
}

/// Places of the scatterers of a row of cells.
SIGMASCAPE_VECTOR_TARGETS void place_row(std::uint64_t key, LatticeCell first, double side_m, std::size_t count,
                                         double* x_m, double* y_m) {
  for (std::size_t i = 0; i < count; ++i) {
    const std::int32_t column = first.column + static_cast<std::int32_t>(i);
    const HashedWords words = hashed_cell(key, column, first.row);
    x_m[i] = (column + (words.first + 0.5) * 0x1p-32) * side_m;
    y_m[i] = (first.row + (words.second + 0.5) * 0x1p-32) * side_m;
  }
}

}  // namespace

ComplexChannels polarized(const DrawnCell& drawn, const Channels& rcs_m2) {
  const float vv = std::sqrt(rcs_m2.vv), hh = std::sqrt(rcs_m2.hh), hv = std::sqrt(rcs_m2.hv);
  const float both = vv * hh;
  const float correlation = both > 0.0F ? std::clamp(rcs_m2.re_vvhh / both, -1.0F, 1.0F) : 0.0F;
  const float rest = std::sqrt(1.0F - correlation * correlation);
  return {{vv * drawn.first.re, vv * drawn.first.im},
          {hh * (correlation * drawn.first.re + rest * drawn.second.re),
           hh * (correlation * drawn.first.im + rest * drawn.second.im)},
          {hv * drawn.third.re, hv * drawn.third.im}};
}

ScattererLattice::ScattererLattice(const LatticeOptions& options) : options_(options) {
  if (!(options.cell_m > 0.0) || !std::isfinite(options.cell_m)) {
    throw Error("scatterer lattice", fmt::format("has cells of {} m", options.cell_m), "give a positive side");
  }
  if (options.levels < 1 || options.levels > most_levels) {
    throw Error("scatterer lattice", fmt::format("has {} levels", options.levels),
                fmt::format("give 1 to {}", most_levels));
  }
}

std::uint64_t ScattererLattice::key(int level, Draw draw, int purpose) const {
  return hashed(options_.seed, level, static_cast<int>(draw), purpose);
}

LatticeCell ScattererLattice::cell_at(Vec2d point, int level) const {
  const double side = cell_m(level);
  return {static_cast<std::int32_t>(std::floor(point.x / side)), static_cast<std::int32_t>(std::floor(point.y / side))};
}

Vec2d ScattererLattice::position_in(LatticeCell cell, int level) const {
  const HashedWords words = hashed_cell(key(level, Draw::First, Place), cell.column, cell.row);
  const double side = cell_m(level);
  return {(cell.column + (words.first + 0.5) * 0x1p-32) * side, (cell.row + (words.second + 0.5) * 0x1p-32) * side};
}

void ScattererLattice::positions_of(LatticeCell first, int level, std::span<double> x_m, std::span<double> y_m) const {
  place_row(key(level, Draw::First, Place), first, cell_m(level), x_m.size(), x_m.data(), y_m.data());
}

ComplexPair ScattererLattice::value_of(LatticeCell cell, int level, Draw draw) const {
  ComplexPair value;
  values_of({&cell.column, 1}, {&cell.row, 1}, level, draw, {&value.re, 1}, {&value.im, 1});
  return value;
}

DrawnCell ScattererLattice::drawn(LatticeCell cell, int level) const {
  return {value_of(cell, level, Draw::First), value_of(cell, level, Draw::Second), value_of(cell, level, Draw::Third)};
}

void ScattererLattice::values_of(std::span<const std::int32_t> columns, std::span<const std::int32_t> rows, int level,
                                 Draw draw, std::span<float> re, std::span<float> im) const {
  const Cells cells{columns.data(), rows.data(), columns.size()};
  const Values values{re.data(), im.data()};
  // Levels above those that are tied together are drawn by themselves.
  const int top = std::max(level, options_.levels - 1);
  draw_cells(cells, top - level, key(top, draw, Value), values);
  for (int parent = top; parent > level; --parent) {
    split_cells(cells, parent - 1 - level,
                SplitKeys{key(parent, draw, WestEast), key(parent, draw, WesternHalf), key(parent, draw, EasternHalf)},
                values);
  }
}

void ScattererLattice::block(LatticeCell coarse, int level, int depth, Draw draw, std::vector<ComplexPair>& out) const {
  const int top = std::max(level, std::min(level + depth, options_.levels - 1));
  // Above the coarsest level there is nothing to split: its cells are drawn one by one.
  const int drawn_depth = level + depth - top;
  std::size_t side = std::size_t{1} << static_cast<unsigned>(drawn_depth);
  LatticeCell corner{coarse.column * static_cast<std::int32_t>(side), coarse.row * static_cast<std::int32_t>(side)};
  out.resize(side * side);
  for (std::size_t y = 0; y < side; ++y) {
    for (std::size_t x = 0; x < side; ++x) {
      out[y * side + x] = value_of(
          {corner.column + static_cast<std::int32_t>(x), corner.row + static_cast<std::int32_t>(y)}, top, draw);
    }
  }
  std::vector<ComplexPair> parents;
  for (int parent = top; parent > level; --parent) {
    parents.swap(out);
    out.resize(4 * side * side);
    const SplitKeys keys =
        SplitKeys{key(parent, draw, WestEast), key(parent, draw, WesternHalf), key(parent, draw, EasternHalf)};
    for (std::size_t y = 0; y < side; ++y) {
      ComplexPair* const south = &out[4 * y * side];
      split_row(&parents[y * side], side, {corner.column, corner.row + static_cast<std::int32_t>(y)}, keys, south,
                south + 2 * side);
    }
    side *= 2;
    corner = {corner.column * 2, corner.row * 2};
  }
}

}  // namespace sigmascape::radar
