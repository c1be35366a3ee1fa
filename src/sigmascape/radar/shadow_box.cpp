#include "sigmascape/radar/shadow_box.h"

#include <algorithm>
#include <cmath>

namespace sigmascape::radar {

std::optional<ShadowBox> ShadowBox::of(const Target& target, double time_s) {
  if (!(target.size_m.x > 0.0 && target.size_m.y > 0.0 && target.size_m.z > 0.0)) return std::nullopt;
  ShadowBox box;
  box.centre_ = target.track.position_at(time_s);
  box.size_m_ = target.size_m;
  const double heading = heading_of(target, time_s);
  box.sine_ = std::sin(heading);
  box.cosine_ = std::cos(heading);
  return box;
}

double ShadowBox::half_diagonal_m() const {
  return 0.5 * std::sqrt(size_m_.x * size_m_.x + size_m_.y * size_m_.y);
}

ShadowBox ShadowBox::seen_from(Vec3d from) const {
  ShadowBox box = *this;
  box.centre_ = centre_ - from;
  return box;
}

bool ShadowBox::hides(Vec3d radar_position, Vec3d place) const {
  const auto in_box = [&](Vec3d v) { return Vec3d{v.x * sine_ + v.y * cosine_, v.x * cosine_ - v.y * sine_, v.z}; };
  // The part of the line from the place to the radar that lies within all three pairs of faces.
  const Vec3d from = in_box(place - centre_), way = in_box(radar_position - place);
  double enters = 0.0, leaves = 1.0;
  const auto clip = [&](double start, double step, double size) {
    if (step == 0.0) {
      if (std::abs(start) > size / 2.0) leaves = -1.0;
      return;
    }
    const double per_step = 1.0 / step, middle = -start * per_step, half = std::abs(0.5 * size * per_step);
    enters = std::max(enters, middle - half);
    leaves = std::min(leaves, middle + half);
  };
  clip(from.x, way.x, size_m_.x);
  clip(from.y, way.y, size_m_.y);
  clip(from.z, way.z, size_m_.z);
  return enters < leaves;
}

}  // namespace sigmascape::radar
