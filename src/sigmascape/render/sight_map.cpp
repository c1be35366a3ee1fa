#include "sigmascape/render/sight_map.h"

#include <algorithm>

#include "sigmascape/base/parallel.h"
#include "sigmascape/radar/rectangle_distances.h"

namespace sigmascape::render {

SightMap::SightMap(const ReflectingGround& ground, Vec3d radar_position, const radar::Rectangle& terrain_extent,
                   const radar::Rectangle& area, double step_m, unsigned threads)
    : origin_{radar_position.x, radar_position.y}, azimuths_(radar::azimuths_of(area, origin_)), step_m_(step_m) {
  const double far_m = radar::farthest_m(area, origin_) + step_m;
  azimuth_step_rad_ = step_m / far_m;
  // Terrain nearer than the area may hide it; only what lies in the area is kept.
  const double start_m = radar::nearest_m(terrain_extent, origin_);
  const auto before =
      static_cast<std::size_t>(std::max(0.0, (radar::nearest_m(area, origin_) - start_m) / step_m - 1.0));
  near_m_ = start_m + static_cast<double>(before) * step_m;
  sights_ = SightGrid(before, static_cast<std::size_t>((far_m - near_m_) / step_m) + 2,
                      static_cast<std::size_t>((azimuths_.right_rad - azimuths_.left_rad) / azimuth_step_rad_) + 1);
  parallel_for(sights_.lines(), threads, [&](std::size_t row, unsigned) {
    const double azimuth =
        azimuths_.middle_rad + azimuths_.left_rad + (static_cast<double>(row) + 0.5) * azimuth_step_rad_;
    ground.walk(azimuth, start_m, far_m + step_m, step_m,
                [&](std::size_t step, double, Vec3d, const terrain::Sight& sight) { sights_.put(step, row, sight); });
  });
}

terrain::Sight SightMap::at(Vec2d point) const {
  const Vec2d away = point - origin_;
  return sights_.at((length(away) - near_m_) / step_m_,
                    (azimuths_.turn_to(away) - azimuths_.left_rad) / azimuth_step_rad_);
}

}  // namespace sigmascape::render
