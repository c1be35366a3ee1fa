#pragma once

#include <algorithm>

#include "sigmascape/base/units.h"
#include "sigmascape/base/vec.h"
#include "sigmascape/radar/ground_grid.h"
#include "sigmascape/radar/rectangle_distances.h"

namespace sigmascape::radar {

/// The azimuths under which an area is seen from a place, as turns from that of its middle.
struct AzimuthSpan {
  double middle_rad = 0.0;                ///< clockwise from north
  double left_rad = -pi, right_rad = pi;  ///< turns from the middle

  /// By how much the azimuth of a point is turned from the middle, from −π to π.
  [[nodiscard]] double turn_to(Vec2d away) const { return turned_by_least(azimuth_of(away) - middle_rad); }
};

/// All round from a place within the area.
[[nodiscard]] inline AzimuthSpan azimuths_of(const Rectangle& area, Vec2d place) {
  const Vec2d to_middle = area.centre() - place;
  AzimuthSpan span{.middle_rad = azimuth_of(to_middle)};
  if (area.contains(place)) return span;
  span.left_rad = span.right_rad = 0.0;
  for (const Vec2d corner : corners_of(area)) {
    const double turn_rad = span.turn_to(corner - place);
    span.left_rad = std::min(span.left_rad, turn_rad);
    span.right_rad = std::max(span.right_rad, turn_rad);
  }
  return span;
}

}  // namespace sigmascape::radar
