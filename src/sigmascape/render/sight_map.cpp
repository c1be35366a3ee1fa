#include "sigmascape/render/sight_map.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "sigmascape/base/parallel.h"
#include "sigmascape/base/units.h"

namespace sigmascape::render {
namespace {

std::array<Vec2d, 4> corners_of(const radar::Rectangle& area) {
  return {Vec2d{area.west_m, area.south_m},
          {area.west_m, area.north_m},
          {area.east_m, area.south_m},
          {area.east_m, area.north_m}};
}

double nearest_m(const radar::Rectangle& area, Vec2d place) {
  return length(Vec2d{std::clamp(place.x, area.west_m, area.east_m), std::clamp(place.y, area.south_m, area.north_m)} -
                place);
}

double farthest_m(const radar::Rectangle& area, Vec2d place) {
  double most = 0.0;
  for (const Vec2d corner : corners_of(area)) most = std::max(most, length(corner - place));
  return most;
}

}  // namespace

SightMap::SightMap(const ReflectingGround& ground, Vec3d radar_position, const radar::Rectangle& terrain_extent,
                   const radar::Rectangle& area, double step_m, unsigned threads)
    : origin_{radar_position.x, radar_position.y}, step_m_(step_m) {
  const Vec2d towards = area.centre() - origin_;
  middle_rad_ = std::atan2(towards.x, towards.y);
  const double far_m = farthest_m(area, origin_) + step_m;
  azimuth_step_rad_ = step_m / far_m;
  double least = 0.0, most = 0.0;
  for (const Vec2d corner : corners_of(area)) {
    least = std::min(least, azimuth_of(corner));
    most = std::max(most, azimuth_of(corner));
  }
  if (area.contains(origin_)) {
    least = -pi;
    most = pi;
  }
  first_azimuth_rad_ = least;
  // Terrain nearer than the area may hide it; only what lies in the area is kept.
  const double start_m = nearest_m(terrain_extent, origin_);
  const auto before = static_cast<std::size_t>(std::max(0.0, (nearest_m(area, origin_) - start_m) / step_m - 1.0));
  near_m_ = start_m + static_cast<double>(before) * step_m;
  parts_ = Array2D<Parts>(static_cast<std::size_t>((far_m - near_m_) / step_m) + 2,
                          static_cast<std::size_t>((most - least) / azimuth_step_rad_) + 1);
  parallel_for(parts_.rows(), threads, [&](std::size_t row, unsigned) {
    const double azimuth = middle_rad_ + first_azimuth_rad_ + (static_cast<double>(row) + 0.5) * azimuth_step_rad_;
    ground.walk(azimuth, start_m, far_m + step_m, step_m,
                [&](std::size_t step, double, Vec3d, const terrain::Sight& sight) {
                  if (step < before || step - before >= parts_.columns()) return;
                  parts_(step - before, row) = {static_cast<float>(sight.ground), static_cast<float>(sight.hidden_m)};
                });
  });
}

double SightMap::azimuth_of(Vec2d point) const {
  const Vec2d away = point - origin_;
  return std::remainder(std::atan2(away.x, away.y) - middle_rad_, 2.0 * pi);
}

terrain::Sight SightMap::at(Vec2d point) const {
  const auto index_of = [](double place, std::size_t count) {
    return static_cast<std::size_t>(std::clamp(place, 0.0, static_cast<double>(count - 1)));
  };
  const Parts& parts = parts_(index_of((length(point - origin_) - near_m_) / step_m_, parts_.columns()),
                              index_of((azimuth_of(point) - first_azimuth_rad_) / azimuth_step_rad_, parts_.rows()));
  return {static_cast<double>(parts.ground), static_cast<double>(parts.hidden_m)};
}

}  // namespace sigmascape::render
