#pragma once

#include <vector>

#include "sigmascape/base/vec.h"
#include "sigmascape/geo/lattice.h"

namespace sigmascape::geo {

/// The four edges of a raster in a local frame, each as points along it, in metres.
struct RasterOutline {
  std::vector<Vec2d> west, east, south, north;

  /// From opposite edges, in any order: a raster may be stored south up, east first or on its side, and the edges are
  /// told apart by where they lie. Points that are not finite are left out; where an edge has no other, as one
  /// beyond a pole, nothing is known of the outline and it is empty.
  static RasterOutline of(std::vector<Vec2d> one, std::vector<Vec2d> opposite, std::vector<Vec2d> other,
                          std::vector<Vec2d> opposite_other);

  [[nodiscard]] bool empty() const { return west.empty(); }

  /// The largest rectangle of the frame's own directions that was found inside: between the innermost points of the
  /// edges, or about the middle where edges run so slantwise that this is more. None of an empty outline.
  [[nodiscard]] Extent extent_inside() const;
  /// The largest within `limit`, or nearly, that holds another and has no point of the edges inside but for those in
  /// that one: grown from a rectangle inside, it lies inside. `limit` itself in an empty outline.
  [[nodiscard]] Extent extent_holding(const Extent& held, const Extent& limit) const;
  /// With points on the straight lines between neighbouring ones besides, so far apart at most where the lines lie in a
  /// rectangle: a small one may lie between two points of the outline of a wide raster.
  [[nodiscard]] RasterOutline with_points_in(const Extent& within, double spacing_m) const;
  /// The farthest that two neighbouring points of the edges lie apart, of those in a rectangle: so far a corner of one
  /// without such points may reach out between two.
  [[nodiscard]] double spacing_m(const Extent& within) const;
  /// What it encloses; 0 of an empty outline.
  [[nodiscard]] double enclosed_m2() const;
  /// Where the line from west to east at that height of the frame goes in and out, ascending; none of an empty outline.
  [[nodiscard]] std::vector<double> crossings_m(double y_m) const;
  /// The smallest that holds all of it; the whole plane around an empty outline.
  [[nodiscard]] Extent extent_around() const;
};

}  // namespace sigmascape::geo
