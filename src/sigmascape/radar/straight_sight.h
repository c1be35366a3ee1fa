#pragma once

#include <cmath>
#include <limits>

#include "sigmascape/base/vec.h"
#include "sigmascape/radar/curved_earth.h"

namespace sigmascape::radar {

/// The line of sight from a point to the radar, by distances over the ground from the point. In the straight space over
/// an Earth that curves it is straight, and between two points of the sea it runs below the sea.
struct StraightSight {
  StraightSight(Vec3d from, Vec3d radar, const CurvedEarth& earth)
      : start(from), curvature_per_m(earth.curvature_per_m()) {
    const Vec3d away = radar - from;
    length_m = std::hypot(away.x, away.y);
    rise = length_m > 0.0 ? away.z / length_m : std::numeric_limits<double>::infinity();
    direction = length_m > 0.0 ? Vec2d{away.x / length_m, away.y / length_m} : Vec2d{};
  }
  /// The same line, moved aside, from where that place lies along it.
  void go_on_beside(Vec2d offset) {
    start = {start.x + offset.x, start.y + offset.y, height_at(dot(offset, direction))};
  }
  [[nodiscard]] Vec2d place_at(double d) const { return {start.x + direction.x * d, start.y + direction.y * d}; }
  [[nodiscard]] double height_at(double d) const {
    return start.z + d * rise - 0.5 * curvature_per_m * d * (length_m - d);
  }
  /// Its slope at the radar, outwards, as SeaHorizon has it.
  [[nodiscard]] double slope_from_radar() const { return -rise - 0.5 * curvature_per_m * length_m; }
  /// Whether it is above that height from there on.
  [[nodiscard]] bool has_left(double height_m, double d) const {
    return height_at(d) > height_m && rise >= 0.5 * curvature_per_m * (length_m - 2.0 * d);
  }

  Vec3d start;
  double curvature_per_m, length_m, rise;
  Vec2d direction;  ///< over the ground, towards the radar
};

}  // namespace sigmascape::radar
