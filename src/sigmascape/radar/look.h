#pragma once

#include <cmath>

#include "sigmascape/base/vec.h"

namespace sigmascape::radar {

/// From where a ground point is seen: the direction from the point to the radar.
struct Aspect {
  double azimuth_rad = 0.0;    ///< clockwise from the frame's north
  double elevation_rad = 0.0;  ///< grazing angle: above the horizontal
};

/// An aspect and a frequency: everything that σ0 of a place depends on besides polarization.
struct Look {
  Aspect aspect;
  double frequency_hz = 0.0;
};

/// The horizontal unit vector from the ground point towards the radar.
[[nodiscard]] inline Vec2d horizontal_direction(double azimuth_rad) {
  return {std::sin(azimuth_rad), std::cos(azimuth_rad)};
}

/// The unit vector from the ground point to the radar.
[[nodiscard]] inline Vec3d direction_to_radar(const Aspect& aspect) {
  const Vec2d horizontal = horizontal_direction(aspect.azimuth_rad);
  const double cos_elevation = std::cos(aspect.elevation_rad);
  return {horizontal.x * cos_elevation, horizontal.y * cos_elevation, std::sin(aspect.elevation_rad)};
}

/// The part of the way to a place that lies to the left of a radar's course, on the map, times its speed.
[[nodiscard]] inline double leftwards(Vec3d velocity_mps, Vec3d away) {
  return cross(Vec2d{velocity_mps.x, velocity_mps.y}, Vec2d{away.x, away.y});
}

/// To which side of its course a radar looks at a place, on the map: "left" or "right", or "neither" when the place
/// lies on the line of the course or the radar stands still.
[[nodiscard]] inline const char* look_side(Vec3d velocity_mps, Vec3d away) {
  const double left = leftwards(velocity_mps, away);
  return left > 0.0 ? "left" : left < 0.0 ? "right" : "neither";
}

}  // namespace sigmascape::radar
