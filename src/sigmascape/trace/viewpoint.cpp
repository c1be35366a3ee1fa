#include "sigmascape/trace/viewpoint.h"

#include <cmath>

namespace sigmascape::trace {

Viewpoint::Viewpoint(bool is_distant, Vec3d to_radar, Vec3d position)
    : is_distant_(is_distant), to_radar_(to_radar), position_(position) {
  const double horizontal = std::hypot(to_radar.x, to_radar.y);
  // The radar looks along −to_radar; its right hand is that direction turned clockwise.
  right_ = horizontal > 0.0 ? Vec3d{-to_radar.y / horizontal, to_radar.x / horizontal, 0.0} : Vec3d{1.0, 0.0, 0.0};
}

Viewpoint Viewpoint::distant(const radar::Aspect& aspect) { return {true, radar::direction_to_radar(aspect), {}}; }
Viewpoint Viewpoint::located(Vec3d position) { return {false, {0.0, 0.0, 1.0}, position}; }

Vec3d Viewpoint::direction_from(Vec3d point) const { return is_distant_ ? to_radar_ : normalized(position_ - point); }

double Viewpoint::range_of(Vec3d point) const { return is_distant_ ? -dot(point, to_radar_) : length(position_ - point); }

double Viewpoint::cross_of(Vec3d point) const {
  return is_distant_ ? dot(point, right_) : std::atan2(point.x - position_.x, point.y - position_.y);
}

Vec2d Viewpoint::shadow_on_plane(Vec3d point, double height_m) const {
  const Vec3d to_radar = direction_from(point);
  const double steps = (height_m - point.z) / to_radar.z;
  return {point.x + steps * to_radar.x, point.y + steps * to_radar.y};
}

double Viewpoint::ray_weight_m2(Vec3d aim, double area_m2, double echo_range_m, double last_range_m) const {
  if (is_distant_) return area_m2 * to_radar_.z;
  const Vec3d away = position_ - aim;
  const double distance2 = dot(away, away);
  const double solid_angle = area_m2 * away.z / (distance2 * std::sqrt(distance2));
  const double ratio = echo_range_m / last_range_m;
  return solid_angle * echo_range_m * echo_range_m * ratio * ratio;
}

}  // namespace sigmascape::trace
