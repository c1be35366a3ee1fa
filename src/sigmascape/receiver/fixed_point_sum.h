#pragma once

#include <atomic>
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

/// Adds so many units, rounded, from any number of threads at once. False, with the sum as it was, when they do not
/// fit.
[[nodiscard]] inline bool add_units(std::int64_t& sum, double units) {
  if (!(std::abs(units) < most_units)) return false;
  const std::int64_t added = std::llrint(units);
  const std::atomic_ref atomic_sum(sum);
  const std::int64_t before = atomic_sum.fetch_add(added, std::memory_order_relaxed);
  if (std::abs(static_cast<double>(before) + static_cast<double>(added)) <= most_units) return true;
  atomic_sum.fetch_sub(added, std::memory_order_relaxed);
  return false;
}

}  // namespace sigmascape::receiver
