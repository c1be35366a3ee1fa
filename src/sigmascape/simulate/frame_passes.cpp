#include "sigmascape/simulate/frame_passes.h"

#include <limits>
#include <utility>
#include <vector>

#include "sigmascape/simulate/error_of_passes.h"

namespace sigmascape::simulate {
namespace {

double total(const std::array<double, radar::Channels::count>& sums) {
  return sums[0] + sums[1] + 2.0 * sums[2];
}

}  // namespace

void FramePasses::add(const receiver::PowerBins& pass) {
  for (std::size_t beam = 0, bin = 0; beam < pass.rows(); ++beam) {
    for (std::size_t range = 0; range < pass.columns(); ++range, ++bin) {
      const radar::Channels rcs_m2 = pass.sum(range, beam);
      const std::array<double, radar::Channels::count> added{
          static_cast<double>(rcs_m2.vv), static_cast<double>(rcs_m2.hh), static_cast<double>(rcs_m2.hv),
          static_cast<double>(rcs_m2.re_vvhh)};
      for (std::size_t channel = 0; channel < added.size(); ++channel) sums_[bin][channel] += added[channel];
      squares_[bin] += total(added) * total(added);
      answers_[bin] += total(added) > 0.0 ? 1 : 0;
    }
  }
  ++passes_;
}

radar::Channels FramePasses::mean(std::size_t bin) const {
  const auto of = [&](std::size_t channel) {
    return static_cast<float>(sums_[bin][channel] / static_cast<double>(passes_));
  };
  return {of(0), of(1), of(2), of(3)};
}

double FramePasses::median_error_db() const {
  if (passes_ < 2) return std::numeric_limits<double>::infinity();
  const auto n = static_cast<double>(passes_);
  std::vector<double> relative_errors;
  for (std::size_t bin = 0; bin < sums_.size(); ++bin) {
    const double sum = total(sums_[bin]);
    if (std::size_t{2} * answers_[bin] < passes_ || !(sum > 0.0)) continue;
    relative_errors.push_back(relative_error_of_mean(sum, squares_[bin], n));
  }
  return simulate::median_error_db(std::move(relative_errors), n);
}

}  // namespace sigmascape::simulate
