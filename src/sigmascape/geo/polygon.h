#pragma once

#include <vector>

#include "sigmascape/base/vec.h"

namespace sigmascape::geo {

/// Corners of a closed line; the last is joined to the first and does not repeat it.
using Ring = std::vector<Vec2d>;

/// An area with holes. The outer ring runs counter-clockwise and holes clockwise, so that the area lies to the left of
/// every edge.
struct Polygon {
  Ring outer;
  std::vector<Ring> holes;
};

/// Positive for counter-clockwise rings.
[[nodiscard]] double signed_area_m2(const Ring& ring);
[[nodiscard]] double area_m2(const Polygon& polygon);
[[nodiscard]] double area_m2(const std::vector<Polygon>& polygons);
[[nodiscard]] double perimeter_m(const Polygon& polygon);

/// The same ring without repeated corners (the closing one included), running the wanted way round.
[[nodiscard]] Ring tidy_ring(Ring ring, bool counter_clockwise);

}  // namespace sigmascape::geo
