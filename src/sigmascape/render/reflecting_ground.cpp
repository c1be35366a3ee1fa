#include "sigmascape/render/reflecting_ground.h"

#include <algorithm>
#include <cmath>

namespace sigmascape::render {
namespace {

/// By what part the sine of the grazing angle may change, and by how much that angle and the azimuth, before the looks
/// are weighted anew.
constexpr double unchanged_aspect = 5e-4;

}  // namespace

void ReflectingGround::Looks::Cursor::turn_to(const atlas::Atlas& atlas, double new_azimuth_rad, double new_sin_grazing,
                                              double frequency_hz) {
  const double cosine = std::sqrt(std::max(0.0, 1.0 - new_sin_grazing * new_sin_grazing));
  if (std::abs(new_sin_grazing - sin_grazing) <= unchanged_aspect * std::min(std::abs(new_sin_grazing), cosine) &&
      std::abs(new_azimuth_rad - azimuth_rad) <= unchanged_aspect) {
    return;
  }
  azimuth_rad = new_azimuth_rad;
  sin_grazing = new_sin_grazing;
  weights = atlas.weights_for({azimuth_rad, std::asin(std::clamp(sin_grazing, -1.0, 1.0))}, frequency_hz);
}

double ReflectingGround::part_seen(Vec3d point, const terrain::Sight& sight) const {
  if (ground_ == nullptr) return sight.ground > 0.0 ? 1.0 : 0.0;
  if (sight.hidden_m == 0.0) return 1.0;
  return terrain::part_above(sight.hidden_m, static_cast<double>(ground_->answering_tops.at({point.x, point.y})));
}

radar::Channels ReflectingGround::sigma0(Vec3d point, double to_radar_rad, const terrain::Sight& sight,
                                         Looks& looks) const {
  const Vec2d place{point.x, point.y};
  const Vec3d towards = towards_radar(point);
  radar::Channels sum;
  if (const double part = part_seen(point, sight); part > 0.0)
    sum = of_textures(place, towards, to_radar_rad, looks.textures_) * static_cast<float>(part);
  if (buildings_ != nullptr) sum += buildings_->sigma0_at(place);
  if (ground_ != nullptr && sight.ground > 0.0)
    sum += of_bare_ground(place, towards, looks.ground_) * static_cast<float>(sight.ground);
  return sum;
}

Vec3d ReflectingGround::towards_radar(Vec3d point) const {
  Vec3d away = radar_position_ - point;
  if (earth_.curvature_per_m() > 0.0) away.z -= earth_.drop_m(std::sqrt(away.x * away.x + away.y * away.y));
  return normalized(away);
}

double ReflectingGround::upright_sine(Vec2d place, Vec3d towards) const {
  const double lowest_rad = atlas_->aspects().elevations_rad.front(), lowest_sine = std::sin(lowest_rad);
  if (towards.z >= lowest_sine) return towards.z;
  const Vec3d normal = terrain_->normal_at(place);
  const double ahead = normal.x * towards.x + normal.y * towards.y, across = std::hypot(towards.x, towards.y);
  const double lowest_local = ahead / across * std::cos(lowest_rad) + normal.z * lowest_sine;
  if (!(lowest_local > 0.0)) return towards.z;
  const double lit_as_lowest = std::clamp(dot(normal, towards) / lowest_local, 0.0, 1.0);
  return std::max(towards.z, lowest_sine * lit_as_lowest);
}

radar::Channels ReflectingGround::of_textures(Vec2d place, Vec3d towards, double to_radar_rad,
                                              Looks::Cursor& cursor) const {
  if (slope_ == SlopeModel::Upright) {
    cursor.turn_to(*atlas_, to_radar_rad, upright_sine(place, towards), frequency_hz_);
    return atlas_->sigma0_at(place, cursor.weights, level_);
  }
  const Vec3d normal = terrain_->normal_at(place);
  cursor.turn_to(*atlas_, to_radar_rad, dot(normal, towards), frequency_hz_);
  return atlas_->sigma0_at(place, cursor.weights, level_) * static_cast<float>(1.0 / normal.z);
}

radar::Channels ReflectingGround::of_bare_ground(Vec2d place, Vec3d towards, Looks::Cursor& cursor) const {
  const Vec3d normal = terrain_->normal_at(place);
  const double sin_grazing = dot(normal, towards);
  if (sin_grazing <= 0.0) return {};
  cursor.turn_to(ground_->sigma0, 0.0, sin_grazing, frequency_hz_);
  return ground_->sigma0.sigma0_at(place, cursor.weights, level_) * static_cast<float>(1.0 / normal.z);
}

}  // namespace sigmascape::render
