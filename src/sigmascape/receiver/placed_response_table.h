#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "sigmascape/receiver/bin_response.h"

namespace sigmascape::receiver {

/// A PlacedResponse at so many places within a bin, for many points in little time: between two of them the weights are
/// those of both, in proportion to their nearness. They keep to those of the response within 1e-5 of its peak where
/// that is no narrower than a bin at half power, however far its side lobes reach.
class PlacedResponseTable {
 public:
  explicit PlacedResponseTable(const PlacedResponse& response);

  /// Bins that a point touches.
  [[nodiscard]] std::size_t taps() const { return taps_; }

  /// Where the weights of a point are: the bin of the first, their row of the table, and how far they are on to the
  /// next.
  struct Place {
    std::ptrdiff_t first_bin = 0;
    std::size_t row = 0;
    float part = 0.0F;
  };
  /// `place` in units of bins, 0.5 being the middle of bin 0.
  [[nodiscard]] Place at(double place) const;
  [[nodiscard]] std::span<const float> lower(const Place& place) const { return row(place.row); }
  [[nodiscard]] std::span<const float> upper(const Place& place) const { return row(place.row + 1); }
  /// One of the weights.
  [[nodiscard]] float weight(const Place& place, std::size_t tap) const {
    const float from = lower(place)[tap];
    return from + place.part * (upper(place)[tap] - from);
  }

 private:
  [[nodiscard]] std::span<const float> row(std::size_t index) const {
    return std::span(weights_).subspan(index * taps_, taps_);
  }

  std::ptrdiff_t first_bin_;  // of a point in bin 0
  std::size_t taps_, steps_;
  std::vector<float> weights_;  // [place within a bin, tap]
};

}  // namespace sigmascape::receiver
