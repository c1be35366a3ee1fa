#pragma once

#include <algorithm>
#include <cstddef>

namespace sigmascape::live {

/// How the nodes of a horizon map lie: along each of a number of directions, evenly spaced over the ground.
struct HorizonGrid {
  double first_azimuth_rad = 0.0;
  double azimuth_step_rad = 1e-3;
  std::size_t azimuths = 0;
  double near_m = 0.0;
  double step_m = 1.0;
  std::size_t distances = 0;
  /// Most steps between the radar and `near_m`: what stands there hides the ground beyond, though it is not mapped.
  /// Steps over obstacles are cut to the size of their squares, here as beyond.
  std::size_t before_near = 256;
  double drop_per_square_m = 0.0;  ///< 1/(2 k R), see radar::CurvedEarth

  /// The last node that is no farther; the first before it, the last beyond all.
  [[nodiscard]] std::size_t node_before(double distance_m) const {
    return static_cast<std::size_t>(
        std::clamp((distance_m - near_m) / step_m, 0.0, static_cast<double>(distances - 1)));
  }

  friend bool operator==(const HorizonGrid&, const HorizonGrid&) = default;
};

}  // namespace sigmascape::live
