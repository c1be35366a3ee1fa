#include "sigmascape/receiver/ground_accumulator.h"

#include <cmath>

namespace sigmascape::receiver {

GroundAccumulator::GroundAccumulator(const radar::GroundGrid& grid, const radar::Aspect& aspect)
    : grid_(grid),
      towards_radar_(radar::horizontal_direction(aspect.azimuth_rad)),
      right_{-towards_radar_.y, towards_radar_.x},
      ground_per_range_(-1.0 / std::cos(aspect.elevation_rad)),
      bins_(grid.columns, grid.rows) {}

void GroundAccumulator::add(std::span<const radar::Echo> echoes) {
  for (const radar::Echo& echo : echoes) {
    const Vec2d point = towards_radar_ * (echo.range_m * ground_per_range_) + right_ * echo.cross;
    const Vec2d cells = grid_.cells_from(point);
    if (cells.x < 0.0 || cells.y < 0.0 || cells.x >= static_cast<double>(grid_.columns) ||
        cells.y >= static_cast<double>(grid_.rows)) {
      continue;
    }
    bins_.add(static_cast<std::size_t>(cells.x), static_cast<std::size_t>(cells.y), echo.rcs_m2);
  }
}

Array2D<radar::Channels> GroundAccumulator::sigma0() const {
  Array2D<radar::Channels> sigma0 = bins_.sums();
  const auto per_area = static_cast<float>(1.0 / grid_.cell_area_m2());
  for (radar::Channels& cell : sigma0.values()) cell = cell * per_area;
  return sigma0;
}

}  // namespace sigmascape::receiver
