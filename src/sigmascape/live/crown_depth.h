#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>

#include "sigmascape/terrain/obstacle_sweep.h"

namespace sigmascape::live {

/// A crown on a stride, in pieces (`terrain::for_each_piece`): between two slopes from the radar over the stride's
/// middle, and level.
struct CrownOverStride {
  float distance_m = 1.0F, stride_m = 0.0F;
  float base_slope = 0.0F, top_slope = 0.0F;
  int pieces = 2;
  float depth_a_piece = 0.0F;

  [[nodiscard]] float lowest_slope() const { return base_slope * (base_slope < 0.0F ? nearest() : farthest()); }
  [[nodiscard]] float highest_slope() const { return top_slope * (top_slope > 0.0F ? nearest() : farthest()); }

  /// Of how many of them the middle lies in the way of a line of sight.
  [[nodiscard]] int pieces_on(float slope) const {
    // Where the line is at the heights of base and top.
    const float distance_a_rise = distance_m / (std::abs(slope) > 1e-12F ? slope : 1e-12F);
    const float pieces_a_m = static_cast<float>(pieces) / stride_m;
    const int to_base = pieces_before((base_slope * distance_a_rise - distance_m) * pieces_a_m),
              to_top = pieces_before((top_slope * distance_a_rise - distance_m) * pieces_a_m);
    return std::abs(to_base - to_top);
  }

 private:
  [[nodiscard]] float nearest() const { return distance_m / std::max(distance_m - 0.5F * stride_m, 1e-3F); }
  [[nodiscard]] float farthest() const { return distance_m / (distance_m + 0.5F * stride_m); }

  /// So many pieces beyond the middle of the stride, or before it.
  [[nodiscard]] int pieces_before(float beyond_middle) const {
    const auto all = static_cast<float>(pieces);
    return static_cast<int>(std::clamp(beyond_middle + 0.5F * (all + 1.0F), 0.0F, all));
  }
};

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

  /// Whether a crown before the node that is to be asked about next is on a line of sight to that or a later one. Most
  /// of what stands on long strides lies between two of them.
  [[nodiscard]] bool comes_upon(const CrownOverStride& crown) {
    go_above(crown.lowest_slope(), base_node_);
    top_node_ = base_node_;
    go_above(crown.highest_slope(), top_node_);
    return base_node_ < top_node_;
  }
  /// A crown that it has come upon last.
  void add(const CrownOverStride& crown) {
    // Of the many pieces of a long stride few have an edge between two lines of sight.
    if (top_node_ - base_node_ <= static_cast<std::size_t>(crown.pieces)) {
      add_by_nodes(crown);
    } else {
      terrain::for_each_piece(crown.pieces, crown.distance_m, crown.stride_m, [&](float nearer) {
        add_piece(crown.base_slope * nearer, crown.top_slope * nearer, crown.depth_a_piece);
      });
    }
  }

  /// Goes on to a node: what is added from now on stands before the next one.
  void meet(std::size_t node) {
    depth_ += waiting_[node];
    next_ = node + 1;
  }
  [[nodiscard]] float transmission() const { return depth_ > 1e-5F ? std::exp(-depth_) : 1.0F; }

 private:
  void add_by_nodes(const CrownOverStride& crown) {
    float before = 0.0F;
    for (std::size_t node = base_node_; node < top_node_; ++node) {
      const float depth = crown.depth_a_piece * static_cast<float>(crown.pieces_on(risen_[node]));
      put(node, depth - before);
      before = depth;
    }
    put(top_node_, -before);
  }

  void add_piece(float base_slope, float top_slope, float depth) {
    go_above(base_slope, base_node_);
    go_above(top_slope, top_node_);
    put(base_node_, depth);
    put(top_node_, -depth);
  }

  /// To the first node from the next one on whose ground is no lower. Most edges are met where the one before was, or a
  /// little farther on.
  void go_above(float slope, std::size_t& node) const {
    if (node <= next_ || !(risen_[node - 1] < slope)) node = std::min(next_, risen_.size());
    if (node == risen_.size() || !(risen_[node] < slope)) return;
    std::size_t reach = 1;
    for (; node + reach < risen_.size() && risen_[node + reach] < slope; reach *= 2) node += reach;
    const auto from = risen_.begin() + static_cast<std::ptrdiff_t>(node),
               end = risen_.begin() + static_cast<std::ptrdiff_t>(std::min(node + reach + 1, risen_.size()));
    node = static_cast<std::size_t>(std::lower_bound(from, end, slope) - risen_.begin());
  }
  void put(std::size_t node, float depth) {
    if (node < waiting_.size()) waiting_[node] += depth;
  }

  std::span<float> waiting_;
  std::span<const float> risen_;
  std::size_t next_ = 0;
  std::size_t base_node_ = 0, top_node_ = 0;  // where the last edges were met
  float depth_ = 0.0F;
};

}  // namespace sigmascape::live
