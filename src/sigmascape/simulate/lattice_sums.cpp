#include "sigmascape/simulate/lattice_sums.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <span>
#include <utility>
#include <vector>

#include "sigmascape/base/hash.h"
#include "sigmascape/receiver/fixed_point_sum.h"

namespace sigmascape::simulate {
namespace {

/// Turns signed numbers into unsigned ones of the same order.
constexpr std::uint32_t sign_bit = 0x80000000U;

/// As many of a list's first as belong together: up to the first two neighbours that part.
template <typename T, typename Parting>
std::span<const T> first_part(std::span<const T> list, const Parting& parting) {
  const auto last = std::ranges::adjacent_find(list, parting);
  return list.first(last == list.end() ? list.size() : static_cast<std::size_t>(last - list.begin()) + 1);
}

}  // namespace

LatticeSums::LatticeSums(double cell_m)
    // A power of two, by which all is multiplied exactly.
    : units_per_m2_(std::exp2(std::ceil(36.0 - 2.0 * std::log2(cell_m)))) {}

std::uint64_t LatticeSums::key_of(radar::LatticeCell cell) {
  const auto number = [](std::int32_t index) { return static_cast<std::uint32_t>(index >> side_bits) ^ sign_bit; };
  return std::uint64_t{number(cell.row)} << 32U | number(cell.column);
}

radar::LatticeCell LatticeSums::first_cell_of(std::uint64_t key) {
  const auto index = [](std::uint64_t number) {
    return static_cast<std::int32_t>(static_cast<std::uint32_t>(number) ^ sign_bit) * side;
  };
  return {index(key), index(key >> 32U)};
}

void LatticeSums::add(radar::LatticeCell cell, const radar::Channels& rcs_m2, Place place) {
  const auto power = static_cast<double>(rcs_m2.power(radar::Polarization::Sum));
  const std::array<double, Count> added_m2{static_cast<double>(rcs_m2.vv),
                                           static_cast<double>(rcs_m2.hh),
                                           static_cast<double>(rcs_m2.hv),
                                           static_cast<double>(rcs_m2.re_vvhh),
                                           power * place.beam,
                                           power * place.range};
  const std::uint64_t key = key_of(cell);
  Shard& shard = shards_[mixed(key) % shard_count];
  const std::lock_guard lock(shard.guard);
  CellSums& sums = shard.squares[key][number_in_square(cell.column & (side - 1), cell.row & (side - 1))];
  for (std::size_t which = 0; which < Count; ++which) {
    if (!receiver::add_units_alone(sums[which], added_m2[which] * units_per_m2_)) ++shard.overflows;
  }
}

void LatticeSums::make_room() {
  constexpr auto half_full = static_cast<std::int64_t>(receiver::most_units / 2.0);
  const auto holds_a_full_one = [](const auto& keyed) {
    return std::ranges::any_of(keyed.second, [](const CellSums& sums) {
      return std::ranges::any_of(sums, [](std::int64_t sum) { return std::abs(sum) > half_full; });
    });
  };
  if (std::ranges::none_of(shards_, [&](const Shard& s) { return std::ranges::any_of(s.squares, holds_a_full_one); }))
    return;
  for (Shard& shard : shards_) {
    for (auto& [key, square] : shard.squares) {
      for (CellSums& sums : square) {
        for (std::int64_t& sum : sums) sum /= 2;
      }
    }
  }
  units_per_m2_ /= 2.0;
}

LatticeSums::Sum LatticeSums::sum_of(const CellSums& sums, double scale) const {
  const auto number = [&sums](Number which) { return static_cast<double>(sums[which]); };
  const double power = number(Vv) + number(Hh) + 2.0 * number(Hv);
  if (!(power > 0.0)) return {};
  const auto m2 = [&](Number which) { return static_cast<float>(number(which) / units_per_m2_ * scale); };
  return {{m2(Vv), m2(Hh), m2(Hv), m2(ReVvhh)}, {number(BeamMoment) / power, number(RangeMoment) / power}};
}

void LatticeSums::for_each_run(double scale, const RunBody& body) const {
  using KeyedSquare = std::pair<std::uint64_t, const Square*>;
  std::vector<KeyedSquare> squares;
  for (const Shard& shard : shards_) {
    for (const auto& [key, square] : shard.squares) squares.emplace_back(key, &square);
  }
  std::ranges::sort(squares);
  const auto are_in_two_rows = [](const KeyedSquare& a, const KeyedSquare& b) {
    return a.first >> 32U != b.first >> 32U;
  };
  const auto are_apart = [](const KeyedSquare& a, const KeyedSquare& b) { return a.first + 1 != b.first; };
  std::vector<Sum> sums;
  for (std::span<const KeyedSquare> left(squares); !left.empty();) {
    const std::span<const KeyedSquare> row_of_squares = first_part(left, are_in_two_rows);
    left = left.subspan(row_of_squares.size());
    for (std::int32_t row = 0; row < side; ++row) {
      for (std::span<const KeyedSquare> rest = row_of_squares; !rest.empty();) {
        const std::span<const KeyedSquare> run = first_part(rest, are_apart);
        rest = rest.subspan(run.size());
        sums.clear();
        for (const auto& [key, square] : run) {
          for (std::int32_t column = 0; column < side; ++column)
            sums.push_back(sum_of((*square)[number_in_square(column, row)], scale));
        }
        const radar::LatticeCell first = first_cell_of(run.front().first);
        body({first.column, first.row + row}, sums);
      }
    }
  }
}

std::size_t LatticeSums::cells_held() const {
  std::size_t squares = 0;
  for (const Shard& shard : shards_) squares += shard.squares.size();
  return squares * side * side;
}

std::uint64_t LatticeSums::overflows() const {
  std::uint64_t overflows = 0;
  for (const Shard& shard : shards_) overflows += shard.overflows;
  return overflows;
}

}  // namespace sigmascape::simulate
