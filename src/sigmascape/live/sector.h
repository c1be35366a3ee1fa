#pragma once

#include <array>
#include <cstddef>

#include "sigmascape/base/vec.h"
#include "sigmascape/radar/ground_grid.h"

namespace sigmascape::live {

/// A piece of a ring about the radar: what lies between two directions, less than half a turn apart, and two distances
/// over the ground, and all that is no farther from it than a margin.
class Sector {
 public:
  Sector() = default;
  /// From its left edge clockwise, and from near to far. A margin reaches as far to all sides, behind the radar too.
  Sector(double first_azimuth_rad, double width_rad, double near_m, double far_m, double margin_m = 0.0);

  /// West and east end of a stretch of a line that runs west to east, from the radar.
  struct Stretch {
    double west_m = 0.0;
    double east_m = 0.0;
  };
  struct Stretches {
    std::array<Stretch, 2> of{};
    std::size_t count = 0;
  };

  /// Where the line `north_m` north of the radar runs through the sector: nowhere, in one stretch, or in two, left and
  /// right of the inner arc.
  [[nodiscard]] Stretches along_row(double north_m) const;
  /// The smallest rectangle that holds the sector, from the radar; with a margin a little larger than that.
  [[nodiscard]] radar::Rectangle bounds() const;

 private:
  double first_azimuth_rad_ = 0.0, width_rad_ = 0.0;
  double near_m_ = 0.0, far_m_ = 0.0, margin_m_ = 0.0;  // the first two with the margin
  Vec2d left_, right_, middle_;                         // along the edges and between them, outwards
};

}  // namespace sigmascape::live
