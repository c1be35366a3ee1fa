#include "sigmascape/simulate/lattice_sums.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdlib>

#include "sigmascape/receiver/fixed_point_sum.h"

namespace sigmascape::simulate {

LatticeSums::LatticeSums(const LatticeBlock& block, double cell_m)
    // A power of two, by which all is multiplied exactly.
    : block_(block),
      units_per_m2_(std::exp2(std::ceil(36.0 - 2.0 * std::log2(cell_m)))),
      cells_(block.columns * block.rows) {}

void LatticeSums::add_units(std::int64_t& sum, double value) {
  if (!receiver::add_units(sum, value * units_per_m2_))
    std::atomic_ref(overflows_).fetch_add(1, std::memory_order_relaxed);
}

void LatticeSums::add(radar::LatticeCell cell, const radar::Channels& rcs_m2, Place place) {
  const auto within = [](std::int32_t index, std::size_t count) {
    return static_cast<std::size_t>(std::clamp<std::int64_t>(index, 0, static_cast<std::int64_t>(count) - 1));
  };
  auto& sums = cells_[within(cell.row - block_.first.row, block_.rows) * block_.columns +
                      within(cell.column - block_.first.column, block_.columns)];
  const auto power = static_cast<double>(rcs_m2.power(radar::Polarization::Sum));
  add_units(sums[Vv], static_cast<double>(rcs_m2.vv));
  add_units(sums[Hh], static_cast<double>(rcs_m2.hh));
  add_units(sums[Hv], static_cast<double>(rcs_m2.hv));
  add_units(sums[ReVvhh], static_cast<double>(rcs_m2.re_vvhh));
  add_units(sums[BeamMoment], power * place.beam);
  add_units(sums[RangeMoment], power * place.range);
}

void LatticeSums::make_room() {
  constexpr auto half_full = static_cast<std::int64_t>(receiver::most_units / 2.0);
  const auto is_full = [](std::int64_t sum) { return std::abs(sum) > half_full; };
  if (std::ranges::none_of(cells_, [&](const auto& sums) { return std::ranges::any_of(sums, is_full); })) return;
  for (auto& sums : cells_) {
    for (std::int64_t& sum : sums) sum /= 2;
  }
  units_per_m2_ /= 2.0;
}

LatticeSums::Sum LatticeSums::sum(std::size_t column, std::size_t row, double scale) const {
  const auto& sums = cells_[row * block_.columns + column];
  const auto number = [&sums](Number which) { return static_cast<double>(sums[which]); };
  const double power = number(Vv) + number(Hh) + 2.0 * number(Hv);
  if (!(power > 0.0)) return {};
  const auto m2 = [&](Number which) { return static_cast<float>(number(which) / units_per_m2_ * scale); };
  return {{m2(Vv), m2(Hh), m2(Hv), m2(ReVvhh)}, {number(BeamMoment) / power, number(RangeMoment) / power}};
}

}  // namespace sigmascape::simulate
