#pragma once

#include <cstddef>
#include <vector>

#include "sigmascape/base/vec.h"
#include "sigmascape/terrain/height_field.h"

namespace sigmascape::render {

/// How the nodes of a horizon map lie: along each of a number of directions, evenly spaced over the ground.
struct HorizonGrid {
  double first_azimuth_rad = 0.0;
  double azimuth_step_rad = 1e-3;
  std::size_t azimuths = 0;
  double near_m = 0.0;
  double step_m = 1.0;
  std::size_t distances = 0;
  /// Nodes between the radar and `near_m`: what stands there hides the ground beyond, though it is not mapped.
  std::size_t before_near = 256;
  double drop_per_square_m = 0.0;  ///< 1/(2 k R), see radar/propagation.h
};

/// The steepest line of sight to the ground met so far, for every direction and distance: what a point must rise above
/// to be seen.
class HorizonMap {
 public:
  explicit HorizonMap(const HorizonGrid& grid);

  /// Keeps its memory as long as the new grid needs no more of it.
  void reset(const HorizonGrid& grid);
  [[nodiscard]] const HorizonGrid& grid() const { return grid_; }

  /// Sweeps outwards along one direction. Directions may be swept by different threads.
  void sweep(std::size_t azimuth, Vec3d radar, const terrain::HeightField& ground);

  /// Slopes (rise over distance) along one direction: of the steepest line of sight to all ground up to each node.
  [[nodiscard]] const float* slopes(std::size_t azimuth) const { return slopes_.data() + azimuth * grid_.distances; }

 private:
  HorizonGrid grid_;
  std::vector<float> slopes_;  // [azimuth][distance]
};

}  // namespace sigmascape::render
