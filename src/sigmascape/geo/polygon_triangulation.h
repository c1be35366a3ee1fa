#pragma once

#include <array>
#include <vector>

#include "sigmascape/geo/polygon.h"

namespace sigmascape::geo {

/// Triangles that fill a valid polygon, with its corners as their only corners: a constrained Delaunay triangulation,
/// counter-clockwise. A corner of one ring that lies on an edge of another, to half a millimetre, divides that edge.
/// Throws Error when it cannot be filled.
[[nodiscard]] std::vector<std::array<Vec2d, 3>> triangulated(const Polygon& polygon);

}  // namespace sigmascape::geo
