#include "sigmascape/receiver/polar_ground.h"

#include <cmath>

namespace sigmascape::receiver {
namespace {

/// Bins along the diagonal of the grid, and one more on either side for the interpolation.
std::size_t side_of(const radar::GroundGrid& grid) {
  return static_cast<std::size_t>(std::ceil(std::hypot(grid.columns, grid.rows))) + 2;
}

}  // namespace

PolarGround::PolarGround(const radar::GroundGrid& grid, const radar::Aspect& aspect)
    : grid_(grid),
      towards_radar_(radar::horizontal_direction(aspect.azimuth_rad)),
      right_{-towards_radar_.y, towards_radar_.x},
      cos_elevation_(std::cos(aspect.elevation_rad)),
      side_(side_of(grid)),
      centre_(grid.extent().centre()),
      bins_(side_, side_) {}

void PolarGround::add(std::span<const radar::Echo> echoes) {
  const double middle = static_cast<double>(side_) / 2.0;
  const double range_step_m = grid_.cell_m * cos_elevation_;
  const double middle_range_m = -dot(centre_, towards_radar_) * cos_elevation_, middle_cross_m = dot(centre_, right_);
  for (const radar::Echo& echo : echoes) {
    const double column = middle + (echo.cross - middle_cross_m) / grid_.cell_m;
    const double row = middle + (echo.range_m - middle_range_m) / range_step_m;
    const auto side = static_cast<double>(side_);
    if (!(column >= 0.0 && row >= 0.0 && column < side && row < side)) continue;
    bins_.add(static_cast<std::size_t>(column), static_cast<std::size_t>(row), echo.rcs_m2);
  }
}

Array2D<radar::Channels> PolarGround::sigma0() const {
  const Array2D<radar::Channels> sums = bins_.sums();
  const auto per_area = static_cast<float>(1.0 / grid_.cell_area_m2());
  const double middle = static_cast<double>(side_) / 2.0;
  Array2D<radar::Channels> sigma0(grid_.columns, grid_.rows);
  for (std::size_t row = 0; row < grid_.rows; ++row) {
    for (std::size_t column = 0; column < grid_.columns; ++column) {
      const Vec2d place = grid_.centre_of(column, row) - centre_;
      const double across = middle + dot(place, right_) / grid_.cell_m - 0.5;
      const double outwards = middle - dot(place, towards_radar_) / grid_.cell_m - 0.5;
      const double left = std::floor(across), near = std::floor(outwards);
      const auto u = static_cast<float>(across - left), v = static_cast<float>(outwards - near);
      const auto c = static_cast<std::size_t>(left), r = static_cast<std::size_t>(near);
      sigma0(column, row) = (sums(c, r) * ((1.0F - u) * (1.0F - v)) + sums(c + 1, r) * (u * (1.0F - v)) +
                             sums(c, r + 1) * ((1.0F - u) * v) + sums(c + 1, r + 1) * (u * v)) *
                            per_area;
    }
  }
  return sigma0;
}

}  // namespace sigmascape::receiver
