#pragma once

#include <array>
#include <vector>

#include "sigmascape/geo/polygon.h"

namespace sigmascape::geo {

/// What polygons have in common and what not. Results are snapped to a grid of 1 mm, have their rings oriented as
/// Polygon says, and hold no part without area. Inputs other than that of `repaired` must be valid (no ring crosses
/// itself or another).

using Polygons = std::vector<Polygon>;

struct Repaired {
  Polygons polygons;  ///< valid, of the same area; empty when nothing with an area is left
  bool was_valid = true;
};

/// Splits self-crossing rings where they cross, keeping what the even-odd rule calls inside.
[[nodiscard]] Repaired repaired(const Polygon& polygon);

/// Removes corners that stand out by less than the tolerance, without making rings cross.
[[nodiscard]] Polygons simplified(const Polygons& polygons, double tolerance_m);
[[nodiscard]] Polygons united(const Polygons& a, const Polygons& b);
/// The union of valid polygons that may overlap one another.
[[nodiscard]] Polygons united_all(const Polygons& polygons);
[[nodiscard]] Polygons subtracted(const Polygons& from, const Polygons& cut);
[[nodiscard]] Polygons intersected(const Polygons& a, const Polygons& b);

/// Triangles that fill the polygon exactly, with its corners as their only corners: the constrained Delaunay
/// triangulation, counter-clockwise.
[[nodiscard]] std::vector<std::array<Vec2d, 3>> triangulated(const Polygon& polygon);

}  // namespace sigmascape::geo
