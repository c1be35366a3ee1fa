#include "sigmascape/trace/viewpoint.h"

#include <algorithm>
#include <cmath>

#include "sigmascape/base/units.h"

namespace sigmascape::trace {
namespace {

/// Shadow and layover of a height under parallel rays: h (cot ψ + tan ψ); nothing straight from above, where there is
/// no ground range.
double distant_landing_m(Vec3d to_radar, double rise_m) {
  // Asked often: std::hypot would take several times as long to no gain, all being of order one.
  const double horizontal = std::sqrt(to_radar.x * to_radar.x + to_radar.y * to_radar.y);
  return horizontal > 0.0 ? rise_m * (horizontal / to_radar.z + to_radar.z / horizontal) : 0.0;
}

}  // namespace

Viewpoint::Viewpoint(bool is_distant, Vec3d to_radar, Vec3d position)
    : is_distant_(is_distant),
      to_radar_(to_radar),
      horizontal_(std::hypot(to_radar.x, to_radar.y)),
      position_(position) {
  // The radar looks along −to_radar; its right hand is that direction turned clockwise.
  right_ = horizontal_ > 0.0 ? Vec3d{-to_radar.y / horizontal_, to_radar.x / horizontal_, 0.0} : Vec3d{1.0, 0.0, 0.0};
}

Viewpoint Viewpoint::distant(const radar::Aspect& aspect) {
  return {true, radar::direction_to_radar(aspect), {}};
}
Viewpoint Viewpoint::located(Vec3d position) {
  return {false, {0.0, 0.0, 1.0}, position};
}

double Viewpoint::middle_cross(double first, double second) const {
  return first + 0.5 * (is_distant_ ? second - first : std::remainder(second - first, 2.0 * pi));
}

double Viewpoint::sin_depression_of(Vec3d first, Vec3d last) const {
  if (is_distant_) return 0.0;
  return (2.0 * position_.z - first.z - last.z) / (range_of(first) + range_of(last));
}

Vec2d Viewpoint::nearest_point(const radar::Rectangle& r) const {
  if (is_distant_) return r.centre();
  return {std::clamp(position_.x, r.west_m, r.east_m), std::clamp(position_.y, r.south_m, r.north_m)};
}

double Viewpoint::landing_before_aim_m(Vec3d aim, double height_m) const {
  const double rise = height_m - aim.z;
  if (is_distant_) return distant_landing_m(to_radar_, rise);
  const double above = position_.z - aim.z, ground = std::hypot(position_.x - aim.x, position_.y - aim.y);
  const double hit_range = std::hypot(ground, above) * (1.0 - rise / above);
  return ground - std::sqrt(std::max(0.0, hit_range * hit_range - above * above));
}

double Viewpoint::aim_behind_landing_m(Vec3d landing, double height_m) const {
  const double rise = height_m - landing.z;
  if (is_distant_) return distant_landing_m(to_radar_, rise);
  const double above = position_.z - landing.z, ground = std::hypot(position_.x - landing.x, position_.y - landing.y);
  // The hit stands at the range of the landing, and its shadow falls from there.
  const double hit_ground = std::sqrt(ground * ground + rise * (2.0 * above - rise));
  return hit_ground * above / (above - rise) - ground;
}

double Viewpoint::point_behind_landing_m(Vec3d landing, double height_m) const {
  const double rise = height_m - landing.z;
  if (is_distant_) return horizontal_ > 0.0 ? rise * to_radar_.z / horizontal_ : 0.0;
  const double above = position_.z - landing.z, ground = std::hypot(position_.x - landing.x, position_.y - landing.y);
  return std::sqrt(ground * ground + rise * (2.0 * above - rise)) - ground;
}

double Viewpoint::landing_before_m(Vec3d point, double height_m) const {
  if (is_distant_) return horizontal_ > 0.0 ? (point.z - height_m) * to_radar_.z / horizontal_ : 0.0;
  const double above = position_.z - height_m, ground = std::hypot(position_.x - point.x, position_.y - point.y);
  const double range = range_of(point);
  return ground - std::sqrt(std::max(0.0, range * range - above * above));
}

Vec2d Viewpoint::shadow_on_plane(Vec3d point, double height_m) const {
  const Vec3d to_radar = direction_from(point);
  const double steps = (height_m - point.z) / to_radar.z;
  return {point.x + steps * to_radar.x, point.y + steps * to_radar.y};
}

double Viewpoint::nearer_before_m(Vec3d place, double late_m) const {
  if (is_distant_) return late_m / horizontal_;
  const double height_m = position_.z - place.z, range_m = std::max(0.0, range_of(place) - late_m);
  return std::hypot(position_.x - place.x, position_.y - place.y) -
         std::sqrt(std::max(0.0, range_m * range_m - height_m * height_m));
}

}  // namespace sigmascape::trace
