#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace sigmascape::receiver {

/// Sums variances of cross-sections, m⁴, from any number of threads, with a result that does not depend on their order.
///
/// Integers again, as in PowerBins, but squares span twice the decades. So every bin has four sums, each of variances
/// of one size in units of its own: the finest is 2⁻⁵³ m⁴, whose root is 1.1e-8 m² and to which less than half of it is
/// rounded up, and from the next size on a variance is told to 1 part in 64 or better. A part's standard deviation s is
/// no larger than the part's total power, so that
///
///     Σ s² ≤ max s · Σ s ≤ max s · 2²⁸ m²
///
/// for the VV + HH + 2 HV that PowerBins can hold, and no sum runs over.
class VarianceBins {
  static constexpr std::size_t sizes = 4;
  using Sums = std::array<std::int64_t, sizes>;

 public:
  static constexpr std::size_t bytes_a_bin = sizeof(Sums);

  explicit VarianceBins(std::size_t bins) : sums_(bins, Sums{}) {}

  void add(std::size_t bin, double variance_m4);
  [[nodiscard]] double sum(std::size_t bin) const;

 private:
  std::vector<Sums> sums_;
};

}  // namespace sigmascape::receiver
