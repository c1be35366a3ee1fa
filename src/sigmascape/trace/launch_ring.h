#pragma once

#include <algorithm>
#include <limits>

#include "sigmascape/base/vec.h"
#include "sigmascape/radar/ground_grid.h"
#include "sigmascape/radar/ground_stretch.h"
#include "sigmascape/radar/rectangle_parts.h"

namespace sigmascape::trace {

/// A rectangle grown by one that is turned towards the radar: what both the least upright rectangle and the least
/// turned one hold.
class LaunchRing {
 public:
  /// Nothing yet; `towards` is a level unit vector.
  explicit LaunchRing(Vec2d towards) : towards_(towards) {}

  void take_in(Vec2d place) {
    upright_ = radar::with_point(upright_, place);
    turned_ = radar::with_point(turned_, turned(place));
  }

  /// Whether the way of that length from `start` along a unit vector comes within `spare_m` of it.
  [[nodiscard]] bool meets(Vec2d start, Vec2d direction, double length_m, double spare_m) const {
    const radar::GroundStretch within = stretch(start, direction, spare_m);
    // Lengths of nothing come rounded to less than that from far away.
    return within.begin_m <= std::min(within.end_m, std::max(length_m, 0.0));
  }
  /// The part of the way from `start` along a unit vector that comes within `spare_m` of it.
  [[nodiscard]] radar::GroundStretch stretch(Vec2d start, Vec2d direction, double spare_m) const {
    const radar::GroundStretch a = radar::stretch_within(radar::widened(upright_, spare_m), start, direction);
    const radar::GroundStretch b =
        radar::stretch_within(radar::widened(turned_, spare_m), turned(start), turned(direction));
    return {std::max(a.begin_m, b.begin_m), std::min(a.end_m, b.end_m)};
  }
  /// Whether a place lies no farther than `spare_m` from it: so does whatever way begins there.
  [[nodiscard]] bool contains(Vec2d place, double spare_m) const {
    return widened(upright_, spare_m).contains(place) && widened(turned_, spare_m).contains(turned(place));
  }
  [[nodiscard]] const radar::Rectangle& upright() const { return upright_; }

 private:
  static constexpr double far = std::numeric_limits<double>::infinity();

  [[nodiscard]] Vec2d turned(Vec2d v) const {
    return {v.x * towards_.y - v.y * towards_.x, v.x * towards_.x + v.y * towards_.y};
  }
  Vec2d towards_;
  radar::Rectangle upright_{far, far, -far, -far}, turned_{far, far, -far, -far};
};

}  // namespace sigmascape::trace
