#pragma once

#include <vector>

#include "sigmascape/geo/polygon.h"

namespace sigmascape::geo {

/// What polygons have in common and what not. Results are snapped to a grid of 1 mm, have their rings oriented as
/// Polygon says, and hold no part without area. Inputs other than that of `repaired` must be valid (no ring crosses
/// itself or another). Each throws Error, which says where, when it cannot be done.

using Polygons = std::vector<Polygon>;

/// How the rings of a polygon lie, each by itself and to one another.
enum class Rings {
  Valid,  ///< at most at single points that leave its inside in one piece
  Touch,  ///< more than that, but none crosses: as a courtyard that lies against the outline or another
  Cross
};

struct Repaired {
  Polygons polygons;  ///< valid, of the same area; empty when nothing with an area is left
  Rings were = Rings::Valid;
};

/// Splits rings where they cross or touch, keeping what the even-odd rule calls inside.
[[nodiscard]] Repaired repaired(const Polygon& polygon);

/// Removes corners that stand out by less than the tolerance, where that makes no rings cross.
[[nodiscard]] Polygons simplified(const Polygons& polygons, double tolerance_m);
[[nodiscard]] Polygons united(const Polygons& a, const Polygons& b);
/// The union of valid polygons that may overlap one another.
[[nodiscard]] Polygons united_all(const Polygons& polygons);
[[nodiscard]] Polygons subtracted(const Polygons& from, const Polygons& cut);
[[nodiscard]] Polygons intersected(const Polygons& a, const Polygons& b);

}  // namespace sigmascape::geo
