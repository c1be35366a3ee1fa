#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>

namespace sigmascape::render {

/// Optical depth of the crowns between the radar and ground that is met outwards, by the slope of its line of sight.
///
/// A crown lies in the way of all slopes from its base's to its top's. As ground that is seen only rises in slope, the
/// two edges of a crown are met once each, in order. They wait in drawers whose bounds crowd where slopes do, with
/// distance over level ground: putting one in and taking one out takes a time that does not depend on how many there
/// are. An edge is met to within a drawer, about half a node of the horizon map.
class CrownDepth {
 public:
  struct Range {
    double lowest_slope = -1.0, highest_slope = 0.0;  ///< of ground that can be seen
  };

  /// Uses `drawers` as its memory.
  CrownDepth(std::span<float> drawers, Range range) : drawers_(drawers) {
    std::ranges::fill(drawers_, 0.0F);
    // Drawers are even in 1 / (vanishing − slope), which grows with the distance of level ground.
    const double spread = std::max(range.highest_slope - range.lowest_slope, 1e-9);
    const double margin = std::max(range.highest_slope < 0.0 ? -range.highest_slope : 1e-3, 1e-3 * spread);
    vanishing_ = static_cast<float>(range.highest_slope + margin);
    first_ = static_cast<float>(1.0 / (spread + margin));
    per_unit_ = static_cast<float>(static_cast<double>(drawers_.size()) / (1.0 / margin - 1.0 / (spread + margin)));
  }

  void add(float base_slope, float top_slope, float depth) {
    put(drawer_of(base_slope), depth);
    put(drawer_of(top_slope), -depth);
  }

  /// Asked with slopes that do not fall.
  [[nodiscard]] float transmission_at(float slope) {
    for (const std::size_t here = drawer_of(slope); next_ <= here; ++next_) depth_ += drawers_[next_];
    return depth_ > 1e-5F ? std::exp(-depth_) : 1.0F;
  }

 private:
  [[nodiscard]] std::size_t drawer_of(float slope) const {
    const float below = vanishing_ - slope;
    const auto last = static_cast<float>(drawers_.size() - 1);
    if (!(below > 0.0F)) return drawers_.size() - 1;
    return static_cast<std::size_t>(std::clamp((1.0F / below - first_) * per_unit_, 0.0F, last));
  }
  void put(std::size_t drawer, float depth) {
    if (drawer < next_) {
      depth_ += depth;
    } else {
      drawers_[drawer] += depth;
    }
  }

  std::span<float> drawers_;
  std::size_t next_ = 0;  // the first drawer that has not been taken out
  float depth_ = 0.0F;
  float vanishing_ = 0.0F, first_ = 0.0F, per_unit_ = 1.0F;
};

}  // namespace sigmascape::render
