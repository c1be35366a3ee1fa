#pragma once

#include "sigmascape/base/vec.h"
#include "sigmascape/radar/ground_grid.h"

namespace sigmascape::live {

/// Ground between two directions, clockwise from the first and up to a whole turn apart, and two distances from a
/// place.
struct GroundSector {
  Vec2d radar;
  double first_azimuth_rad = 0.0, width_rad = 0.0;
  double near_m = 0.0, far_m = 0.0;

  /// The smallest rectangle that holds it.
  [[nodiscard]] radar::Rectangle bounds() const;
  /// Whether some of it may lie in a square; true for each that it shares ground with, and for few others.
  [[nodiscard]] bool may_meet(const radar::Rectangle& square) const;
  /// How many squares of a lattice of that spacing it may meet, in the mean over all places of the lattice.
  [[nodiscard]] double squares_met(double side_m) const;
};

}  // namespace sigmascape::live
