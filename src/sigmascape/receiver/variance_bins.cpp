#include "sigmascape/receiver/variance_bins.h"

#include <algorithm>
#include <atomic>
#include <cmath>

namespace sigmascape::receiver {
namespace {

/// Variances of one size: below `end_m4`, and of the next smaller size beneath.
struct Size {
  double end_m4, units_per_m4;
};

// √end · 2²⁸ m² · units stays below 2⁶³ for each.
constexpr std::array<Size, 4> known_sizes{{{0x1p-38, 0x1p53}, {0x1p-20, 0x1p44}, {0x1p4, 0x1p32}, {0x1p56, 0x1p6}}};

}  // namespace

void VarianceBins::add(std::size_t bin, double variance_m4) {
  std::size_t size = 0;
  while (size + 1 < sizes && variance_m4 >= known_sizes[size].end_m4) ++size;
  const double units = std::min(variance_m4, known_sizes.back().end_m4) * known_sizes[size].units_per_m4;
  // What is noisy at all is not said to be exact, however dark it is.
  const long long whole = variance_m4 > 0.0 ? std::max(std::llrint(units), 1LL) : 0;
  std::atomic_ref(sums_[bin][size]).fetch_add(whole, std::memory_order_relaxed);
}

double VarianceBins::sum(std::size_t bin) const {
  double sum_m4 = 0.0;
  for (std::size_t size = 0; size < sizes; ++size)
    sum_m4 += static_cast<double>(sums_[bin][size]) / known_sizes[size].units_per_m4;
  return sum_m4;
}

}  // namespace sigmascape::receiver
