#include "sigmascape/render/sight_map.h"

#include <algorithm>
#include <cmath>

#include "sigmascape/base/parallel.h"
#include "sigmascape/base/units.h"
#include "sigmascape/radar/rectangle_distances.h"

namespace sigmascape::render {
SightMap::SightMap(const ReflectingGround& ground, Vec3d radar_position, const radar::Rectangle& terrain_extent,
                   const radar::Rectangle& area, double step_m, unsigned threads)
    : origin_{radar_position.x, radar_position.y}, step_m_(step_m) {
  const Vec2d towards = area.centre() - origin_;
  middle_rad_ = std::atan2(towards.x, towards.y);
  const double far_m = radar::farthest_m(area, origin_) + step_m;
  azimuth_step_rad_ = step_m / far_m;
  double least = 0.0, most = 0.0;
  for (const Vec2d corner : radar::corners_of(area)) {
    least = std::min(least, azimuth_of(corner));
    most = std::max(most, azimuth_of(corner));
  }
  if (area.contains(origin_)) {
    least = -pi;
    most = pi;
  }
  first_azimuth_rad_ = least;
  // Terrain nearer than the area may hide it; only what lies in the area is kept.
  const double start_m = radar::nearest_m(terrain_extent, origin_);
  const auto before =
      static_cast<std::size_t>(std::max(0.0, (radar::nearest_m(area, origin_) - start_m) / step_m - 1.0));
  near_m_ = start_m + static_cast<double>(before) * step_m;
  sights_ = SightGrid(before, static_cast<std::size_t>((far_m - near_m_) / step_m) + 2,
                      static_cast<std::size_t>((most - least) / azimuth_step_rad_) + 1);
  parallel_for(sights_.lines(), threads, [&](std::size_t row, unsigned) {
    const double azimuth = middle_rad_ + first_azimuth_rad_ + (static_cast<double>(row) + 0.5) * azimuth_step_rad_;
    ground.walk(azimuth, start_m, far_m + step_m, step_m,
                [&](std::size_t step, double, Vec3d, const terrain::Sight& sight) { sights_.put(step, row, sight); });
  });
}

double SightMap::azimuth_of(Vec2d point) const {
  const Vec2d away = point - origin_;
  return std::remainder(std::atan2(away.x, away.y) - middle_rad_, 2.0 * pi);
}

terrain::Sight SightMap::at(Vec2d point) const {
  return sights_.at((length(point - origin_) - near_m_) / step_m_,
                    (azimuth_of(point) - first_azimuth_rad_) / azimuth_step_rad_);
}

}  // namespace sigmascape::render
