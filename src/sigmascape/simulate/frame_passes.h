#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "sigmascape/radar/channels.h"
#include "sigmascape/receiver/power_bins.h"

namespace sigmascape::simulate {

/// Sums of a frame's bins over independent passes of the same rays a cell: their mean, and what their scatter says of
/// its error. docs/decisions/0066-tracing-to-an-error.md says why by passes.
class FramePasses {
 public:
  explicit FramePasses(std::size_t bins) : sums_(bins), squares_(bins), answers_(bins) {}

  /// `pass` holds one beam a row: bins follow one another by beams, then ranges.
  void add(const receiver::PowerBins& pass);

  [[nodiscard]] std::uint64_t passes() const { return passes_; }
  [[nodiscard]] radar::Channels mean(std::size_t bin) const;
  /// Standard error of the mean total power of a bin, 10 lg(1 + s/P), in the median over the bins that answer to at
  /// least half of the passes: paths that now and then find their way into a shadow would else have more and more of a
  /// say. Infinite after fewer than two passes, 0 when no bin answers.
  [[nodiscard]] double median_error_db() const;

 private:
  std::vector<std::array<double, radar::Channels::count>> sums_;
  std::vector<double> squares_;         // of the total power
  std::vector<std::uint32_t> answers_;  // passes that brought anything
  std::uint64_t passes_ = 0;
};

}  // namespace sigmascape::simulate
