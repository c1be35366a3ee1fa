#include "sigmascape/scene/smooth_line.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace sigmascape::scene {
namespace {

/// Between b (t = 0) and c (t = 1), with the tangents that the neighbours a and d give.
Vec2d catmull_rom(Vec2d a, Vec2d b, Vec2d c, Vec2d d, double t) {
  const Vec2d linear = (c - a) * t;
  const Vec2d square = (a * 2.0 - b * 5.0 + c * 4.0 - d) * (t * t);
  const Vec2d cube = (b * 3.0 - a - c * 3.0 + d) * (t * t * t);
  return b + (linear + square + cube) * 0.5;
}

}  // namespace

SmoothLine::SmoothLine(std::span<const Vec2d> control_points, double step_m) {
  const std::size_t last = control_points.size() - 1;
  for (std::size_t i = 0; i < last; ++i) {
    const Vec2d a = control_points[i == 0 ? 0 : i - 1], b = control_points[i], c = control_points[i + 1];
    const Vec2d d = control_points[std::min(i + 2, last)];
    const int steps = std::max(1, static_cast<int>(std::ceil(length(c - b) / step_m)));
    for (int step = 0; step < steps; ++step)
      points_.push_back(catmull_rom(a, b, c, d, static_cast<double>(step) / steps));
  }
  points_.push_back(control_points[last]);
}

NearestOnLine SmoothLine::nearest_to(Vec2d p) const {
  double best_square = std::numeric_limits<double>::infinity();
  std::size_t best_piece = 0;
  Vec2d best_point;
  for (std::size_t i = 0; i + 1 < points_.size(); ++i) {
    const Vec2d from = points_[i], run = points_[i + 1] - from;
    const Vec2d point = from + run * std::clamp(dot(p - from, run) / dot(run, run), 0.0, 1.0);
    const double square = dot(p - point, p - point);
    if (square >= best_square) continue;
    best_square = square;
    best_piece = i;
    best_point = point;
  }
  const Vec2d run = points_[best_piece + 1] - points_[best_piece];
  return {std::sqrt(best_square), best_point, run * (1.0 / length(run))};
}

}  // namespace sigmascape::scene
