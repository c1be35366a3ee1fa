#pragma once

#include <cstdint>

#include "sigmascape/radar/channels.h"

namespace sigmascape::radar {

/// What one path brings back: the record that the tracer hands to the receiver.
struct Echo {
  /// Half the length of the way out and back, in metres: from the radar, or, when the radar is at infinity, from the
  /// plane through the local origin that faces it (negative towards the radar).
  double range_m = 0.0;
  /// Mean of the first and last surface point's position across the line of sight: azimuth in radians, clockwise, of
  /// the direction from the radar; when the radar is at infinity, metres to the right as seen from it.
  double cross = 0.0;
  /// The cross-section, in m², of a point at `range_m` that would return the same power.
  Channels rcs_m2;
  /// Number of surfaces on the way: 1 is a direct echo.
  std::uint8_t bounces = 1;
  /// Sine of the angle below the radar's horizontal from which it arrives, for the antenna's elevation pattern: the
  /// mean height of first and last surface point below the radar over their mean distance. Zero when the radar is at
  /// infinity.
  float sin_depression = 0.0F;
  /// Whether this is the ground's direct echo: no surface but the bare ground had a part in it.
  bool from_ground = false;
  /// Whether it is a building's direct echo: no surface but one of scene::Scene::buildings had a part in it.
  bool from_building = false;
};

}  // namespace sigmascape::radar
