#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace sigmascape::receiver {

/// Sums variances of cross-sections, m⁴, from any number of threads, with a result that does not depend on their order.
///
/// Integers again, as in PowerBins, but squares span twice the decades. So every bin has four sums, each of variances
/// of one size in units of its own: the finest is 2⁻⁵⁶ m⁴, whose root is 3.7e-9 m², and from the next size on a
/// variance is told to 1 part in 64 or better. A part's standard deviation s is no larger than the part itself, so that
///
///     Σ s² ≤ max s · Σ s ≤ max s · 2²⁶ m²
///
/// for what PowerBins can hold, and no sum runs over.
class VarianceBins {
 public:
  explicit VarianceBins(std::size_t bins) : sums_(bins, Sums{}) {}

  void add(std::size_t bin, double variance_m4);
  [[nodiscard]] double sum(std::size_t bin) const;

 private:
  static constexpr std::size_t sizes = 4;
  using Sums = std::array<std::int64_t, sizes>;

  std::vector<Sums> sums_;
};

}  // namespace sigmascape::receiver
