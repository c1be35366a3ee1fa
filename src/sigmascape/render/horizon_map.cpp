#include "sigmascape/render/horizon_map.h"

#include <algorithm>
#include <limits>

#include "sigmascape/radar/look.h"

namespace sigmascape::render {

HorizonMap::HorizonMap(const HorizonGrid& grid) {
  reset(grid);
}

void HorizonMap::reset(const HorizonGrid& grid) {
  grid_ = grid;
  if (slopes_.size() < grid.azimuths * grid.distances) slopes_.resize(grid.azimuths * grid.distances);
}

void HorizonMap::sweep(std::size_t azimuth, Vec3d radar, const terrain::HeightField& ground) {
  const Vec2d direction =
      radar::horizontal_direction(grid_.first_azimuth_rad + static_cast<double>(azimuth) * grid_.azimuth_step_rad);
  const radar::Rectangle extent = ground.extent();
  const auto slope_at = [&](double distance) {
    const Vec2d point = Vec2d{radar.x, radar.y} + direction * distance;
    if (!extent.contains(point)) return -std::numeric_limits<double>::infinity();
    const double height = ground.height_at(point) - grid_.drop_per_square_m * distance * distance;
    return (height - radar.z) / distance;
  };
  double steepest = -std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < grid_.before_near; ++k) {
    const double part = (static_cast<double>(k) + 0.5) / static_cast<double>(grid_.before_near);
    steepest = std::max(steepest, slope_at(part * grid_.near_m));
  }
  float* const slopes = slopes_.data() + azimuth * grid_.distances;
  for (std::size_t k = 0; k < grid_.distances; ++k) {
    steepest = std::max(steepest, slope_at(grid_.near_m + static_cast<double>(k) * grid_.step_m));
    slopes[k] = static_cast<float>(steepest);
  }
}

}  // namespace sigmascape::render
