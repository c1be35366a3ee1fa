#pragma once

#include <span>
#include <vector>

#include "sigmascape/base/vec.h"

namespace sigmascape::scene {

/// A point beside a line.
struct NearestOnLine {
  double distance_m = 0.0;
  Vec2d point;      ///< on the line
  Vec2d direction;  ///< of the line there, unit length
};

/// The Catmull–Rom curve through control points, as short straight pieces: rivers and roads.
class SmoothLine {
 public:
  SmoothLine() = default;
  SmoothLine(std::span<const Vec2d> control_points, double step_m);

  [[nodiscard]] const std::vector<Vec2d>& points() const { return points_; }
  [[nodiscard]] NearestOnLine nearest_to(Vec2d p) const;

  /// Calls `visit(point, direction)` every `spacing_m` along the line.
  template <typename Visit>
  void for_each_step(double spacing_m, const Visit& visit) const {
    double ahead_m = 0.0;
    for (std::size_t i = 0; i + 1 < points_.size(); ++i) {
      const double run_m = length(points_[i + 1] - points_[i]);
      const Vec2d direction = (points_[i + 1] - points_[i]) * (1.0 / run_m);
      for (; ahead_m < run_m; ahead_m += spacing_m) visit(points_[i] + direction * ahead_m, direction);
      ahead_m -= run_m;
    }
  }

 private:
  std::vector<Vec2d> points_;
};

/// The direction turned a quarter to the right.
[[nodiscard]] constexpr Vec2d right_of(Vec2d direction) {
  return {direction.y, -direction.x};
}

}  // namespace sigmascape::scene
