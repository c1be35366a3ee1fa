#pragma once

#include <cmath>
#include <cstdint>

namespace sigmascape::receiver {

/// Sums in whole units do not depend on the order of what is added; up to so many units they leave room for one more.
inline constexpr double most_units = 0x1p62;

/// Adds so many units, rounded. False, with the sum as it was, when they do not fit. For one thread at a time.
[[nodiscard]] inline bool add_units_alone(std::int64_t& sum, double units) {
  if (!(std::abs(units) < most_units)) return false;
  const std::int64_t added = std::llrint(units);
  if (!(std::abs(static_cast<double>(sum) + static_cast<double>(added)) <= most_units)) return false;
  sum += added;
  return true;
}

/// In how many parts of a unit the rest of a sum is counted.
inline constexpr double parts_a_unit = 0x1p32;
/// Rounding to whole units is felt by less than 2⁻¹⁷ from so many on.
inline constexpr double finely_below_units = 0x1p16;

/// Adds so many units, fewer of them to the nearest 2⁻³² of one; `rest` is what the sum has beyond whole units, in
/// these parts. False, with the sum as it was, when they do not fit. For one thread at a time.
[[nodiscard]] inline bool add_finely_alone(std::int64_t& sum, std::uint32_t& rest, double units) {
  if (!(std::abs(units) < finely_below_units)) return add_units_alone(sum, units);
  const auto cut = static_cast<double>(static_cast<std::int64_t>(units));
  const double whole = cut > units ? cut - 1.0 : cut;
  const auto parts = static_cast<std::uint64_t>(std::llrint((units - whole) * parts_a_unit)) + rest;
  if (!add_units_alone(sum, whole + static_cast<double>(parts >> 32U))) return false;
  rest = static_cast<std::uint32_t>(parts);
  return true;
}

/// Adds one such sum to another.
[[nodiscard]] inline bool add_sum_alone(std::int64_t& sum, std::uint32_t& rest, std::int64_t added,
                                        std::uint32_t added_rest) {
  const std::uint64_t parts = std::uint64_t{rest} + added_rest;
  const std::int64_t units = added + static_cast<std::int64_t>(parts >> 32U);
  if (!(std::abs(static_cast<double>(sum) + static_cast<double>(units)) <= most_units)) return false;
  sum += units;
  rest = static_cast<std::uint32_t>(parts);
  return true;
}

}  // namespace sigmascape::receiver
