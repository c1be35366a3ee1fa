#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

namespace sigmascape::receiver {

/// How a point spreads over the bins of one axis, tabulated at so many places within a bin that finding its weights is
/// one look-up.
///
/// Weights of power sum to one at every place, those of amplitude have squares that do: a point keeps its cross-section
/// wherever in a bin it lies, and its centroid within 1/256 of a bin.
class PointResponse {
 public:
  static constexpr std::size_t most_taps = 16;

  /// Shared between the two nearest bins in proportion to its nearness, as live frames share the ground.
  [[nodiscard]] static PointResponse shared();
  /// By a response in voltage over the offset in bins, side lobes with their sign; followed until no more than 1e-3 of
  /// its power is left out, over `most_taps` bins at most.
  [[nodiscard]] static PointResponse of(const std::function<double(double offset_bins)>& voltage);

  /// Bins that a point touches.
  [[nodiscard]] std::size_t taps() const { return taps_; }

  /// Where the weights of a point begin: the bin of the first and their place in the table.
  struct Place {
    std::ptrdiff_t first_bin = 0;
    std::size_t row = 0;
  };
  /// `position` in units of bins, 0.5 being the middle of bin 0; at least −10⁶.
  [[nodiscard]] Place place_of(double position) const;
  [[nodiscard]] std::span<const float> power(std::size_t row) const { return {&powers_[row * taps_], taps_}; }
  [[nodiscard]] std::span<const float> amplitude(std::size_t row) const { return {&amplitudes_[row * taps_], taps_}; }

 private:
  PointResponse(std::size_t taps, const std::function<double(double offset_bins)>& voltage);

  std::size_t taps_;
  std::vector<float> powers_, amplitudes_;  // [place within a bin, tap]
};

}  // namespace sigmascape::receiver
