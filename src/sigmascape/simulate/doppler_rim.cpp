#include "sigmascape/simulate/doppler_rim.h"

#include <cmath>

#include "sigmascape/base/units.h"
#include "sigmascape/radar/rectangle_distances.h"

namespace sigmascape::simulate {
namespace {

Vec2d level(Vec3d v) {
  return {v.x, v.y};
}

/// 1 or −1 where all of a rectangle lies left or right of a course through a place, 0 where it lies on both sides.
double side_of(const radar::Rectangle& rectangle, Vec2d foot, Vec2d course) {
  const auto [least_m, most_m] = radar::span_over(rectangle, [&](Vec2d place) { return cross(course, place - foot); });
  return least_m >= 0.0 ? 1.0 : most_m <= 0.0 ? -1.0 : 0.0;
}

}  // namespace

DopplerRim::DopplerRim(const radar::Radar& radar, const radar::Rectangle& mapped, const radar::Rectangle& area)
    : mapped_(mapped), area_(area), position_(radar.position), earth_(radar::earth_of(radar)) {
  const Vec2d foot = level(position_), velocity_mps = level(radar.velocity_mps);
  const double speed_mps = length(velocity_mps);
  course_ = speed_mps > 0.0 ? velocity_mps * (1.0 / speed_mps) : Vec2d{0.0, 1.0};
  fold_ = wavelength_m(radar.frequency_hz) * radar.waveform.pulse_repetition_hz / (2.0 * speed_mps);
  middle_ = cosine_off_course(mapped.centre() - foot);
  map_on_side_ = side_of(mapped, foot, course_);
  // As one goes along a straight line, the angle off the course turns one way: corners have the least and the most.
  if (side_of(area, foot, course_) == 0.0) return;
  const auto [least, most] = radar::span_over(area, [&](Vec2d place) { return cosine_off_course(place - foot); });
  reach_ = most - least;
}

double DopplerRim::cosine_off_course(Vec2d away) const {
  return dot(course_, away) / length(away);
}

bool DopplerRim::takes_part(Vec3d place) const {
  if (mapped_.contains(level(place))) return true;
  const Vec2d foot = level(position_), away = level(place) - foot, beside{-course_.y, course_.x};
  const double side = dot(beside, away) < 0.0 ? -1.0 : 1.0;
  if (side * map_on_side_ < 0.0) return false;
  const Vec3d bent = earth_.bent(place, foot) - position_;
  // One repetition frequency of Doppler along the arc of this range.
  const double step = fold_ * length(bent) / length(level(bent));
  const double cosine = cosine_off_course(away), ground_range_m = length(away);
  const auto counts_instead = [&](double other) {
    if (std::abs(other) > 1.0) return false;
    const Vec2d twin = foot + (course_ * other + beside * (side * std::sqrt(1.0 - other * other))) * ground_range_m;
    if (mapped_.contains(twin)) return true;
    return area_.contains(twin) && std::abs(other - middle_) < std::abs(cosine - middle_);
  };
  for (double off = step; off <= reach_; off += step) {
    if (counts_instead(cosine - off) || counts_instead(cosine + off)) return false;
  }
  return true;
}

}  // namespace sigmascape::simulate
