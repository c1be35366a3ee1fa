#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>

namespace sigmascape::render {

/// Optical depth of the crowns between the radar and the ground of the nodes that are met outwards, by the slope of its
/// line of sight.
///
/// A crown lies in the way of all slopes from its base's to its top's. As ground that is seen only rises in slope, the
/// two edges of a crown are met once each, in order: each waits at the node from which ground is seen above it.
class CrownDepth {
 public:
  /// `risen[k]`: the steepest line of sight to the ground up to node k. Of those not asked about yet it must stay as it
  /// is. Uses `waiting`, as many numbers, as its memory.
  CrownDepth(std::span<float> waiting, std::span<const float> risen) : waiting_(waiting), risen_(risen) {
    std::ranges::fill(waiting_, 0.0F);
  }

  /// Of a crown before the node that is to be asked about next.
  void add(float base_slope, float top_slope, float depth) {
    put(node_above(base_slope), depth);
    put(node_above(top_slope), -depth);
  }

  /// Goes on to a node: what is added from now on stands before the next one.
  void meet(std::size_t node) {
    depth_ += waiting_[node];
    next_ = node + 1;
  }
  [[nodiscard]] float transmission() const { return depth_ > 1e-5F ? std::exp(-depth_) : 1.0F; }

 private:
  /// The first from the next one on whose ground is no lower. Most lie near by.
  [[nodiscard]] std::size_t node_above(float slope) const {
    std::size_t from = next_, reach = 1;
    while (from + reach < risen_.size() && risen_[from + reach] < slope) {
      from += reach;
      reach *= 2;
    }
    const auto end = risen_.begin() + static_cast<std::ptrdiff_t>(std::min(from + reach + 1, risen_.size()));
    return static_cast<std::size_t>(
        std::lower_bound(risen_.begin() + static_cast<std::ptrdiff_t>(std::min(from, risen_.size())), end, slope) -
        risen_.begin());
  }
  void put(std::size_t node, float depth) {
    if (node < waiting_.size()) waiting_[node] += depth;
  }

  std::span<float> waiting_;
  std::span<const float> risen_;
  std::size_t next_ = 0;
  float depth_ = 0.0F;
};

}  // namespace sigmascape::render
