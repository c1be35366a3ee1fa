#include "sigmascape/receiver/variance_bins.h"

#include <algorithm>
#include <atomic>
#include <cmath>

namespace sigmascape::receiver {
namespace {

constexpr double fine_units_per_m4 = 0x1p44;
constexpr double coarse_units_per_m4 = 0x1p4;
constexpr double coarse_from_m4 = 0x1p10;
constexpr double most_m4 = 0x1p56;

}  // namespace

void VarianceBins::add(std::size_t bin, double variance_m4) {
  const bool is_fine = variance_m4 < coarse_from_m4;
  const double units = is_fine ? variance_m4 * fine_units_per_m4 : std::min(variance_m4, most_m4) * coarse_units_per_m4;
  std::atomic_ref(is_fine ? fine_[bin] : coarse_[bin]).fetch_add(std::llrint(units), std::memory_order_relaxed);
}

double VarianceBins::sum(std::size_t bin) const {
  return static_cast<double>(fine_[bin]) / fine_units_per_m4 + static_cast<double>(coarse_[bin]) / coarse_units_per_m4;
}

}  // namespace sigmascape::receiver
