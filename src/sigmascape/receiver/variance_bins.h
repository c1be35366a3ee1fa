#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace sigmascape::receiver {

/// Sums variances of cross-sections, m⁴, from any number of threads, with a result that does not depend on their order.
///
/// Integers again, as in PowerBins, but squares span twice the decades. So every bin has two sums: of small variances
/// in units of 2⁻⁴⁴ m⁴, whose root is 2.4e-7 m², and of those from 2¹⁰ m⁴ in units of 2⁻⁴ m⁴. What is beyond 2⁵⁶ m⁴
/// counts as that much.
class VarianceBins {
 public:
  explicit VarianceBins(std::size_t bins) : fine_(bins, 0), coarse_(bins, 0) {}

  void add(std::size_t bin, double variance_m4);
  [[nodiscard]] double sum(std::size_t bin) const;

 private:
  std::vector<std::int64_t> fine_, coarse_;
};

}  // namespace sigmascape::receiver
