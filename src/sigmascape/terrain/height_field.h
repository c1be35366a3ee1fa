#pragma once

#include "sigmascape/base/array2d.h"
#include "sigmascape/base/vec.h"
#include "sigmascape/radar/ground_grid.h"

namespace sigmascape::terrain {

/// Heights at the corners of square cells of the local frame, bilinear between them.
///
/// Node (column, row) stands at (west + column · spacing, north − row · spacing); row 0 is the northernmost.
struct HeightField {
  double west_m = 0.0;
  double north_m = 0.0;
  double spacing_m = 1.0;
  Array2D<float> height_m;  ///< [column, row], orthometric

  [[nodiscard]] radar::Rectangle extent() const;
  /// Height of the ground; outside the field that of the nearest edge.
  [[nodiscard]] double height_at(Vec2d point) const;
  /// Upward unit normal of the bilinear surface; outside the field that of the nearest edge.
  [[nodiscard]] Vec3d normal_at(Vec2d point) const;
  [[nodiscard]] float lowest_m() const;
  [[nodiscard]] float highest_m() const;
};

}  // namespace sigmascape::terrain
