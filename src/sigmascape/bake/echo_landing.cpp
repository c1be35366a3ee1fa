#include "sigmascape/bake/echo_landing.h"

#include <cmath>

namespace sigmascape::bake {
namespace {

/// A small part of any texel.
constexpr double near_enough_m = 0.01;
/// Far more than regula falsi needs on ground that does not lie over itself.
constexpr int most_steps = 40;

}  // namespace

EchoLanding::EchoLanding(const radar::Aspect& aspect)
    : towards_radar_(radar::horizontal_direction(aspect.azimuth_rad)),
      right_{-towards_radar_.y, towards_radar_.x},
      sine_(std::sin(aspect.elevation_rad)),
      cosine_(std::cos(aspect.elevation_rad)) {}

EchoLanding::EchoLanding(const radar::Aspect& aspect, const terrain::HeightField& relief, double lowest_m,
                         double highest_m)
    : EchoLanding(aspect) {
  relief_ = &relief;
  lowest_m_ = lowest_m;
  highest_m_ = highest_m;
}

Vec2d EchoLanding::place_of(const radar::Echo& echo) const {
  const Vec2d across = right_ * echo.cross;
  const double distance_m = relief_ == nullptr ? -echo.range_m / cosine_ : distance_on_relief(echo.range_m, across);
  return towards_radar_ * distance_m + across;
}

/// Regula falsi in its Illinois form between where the lowest and the highest ground would have that range.
double EchoLanding::distance_on_relief(double range_m, Vec2d across) const {
  const auto nearer_by = [&](double distance_m) {
    return distance_m * cosine_ + relief_->height_at(towards_radar_ * distance_m + across) * sine_ + range_m;
  };
  double low = (-range_m - highest_m_ * sine_) / cosine_, high = (-range_m - lowest_m_ * sine_) / cosine_;
  double at_low = nearer_by(low), at_high = nearer_by(high);
  // The lowest ground itself: of places before and upon a quay that have one range that at the foot of its wall, where
  // what meets in the corner stands.
  if (std::abs(at_high) < near_enough_m * cosine_) return high;
  if (std::abs(at_low) < near_enough_m * cosine_) return low;
  int last_side = 0;
  for (int step = 0; step < most_steps && high - low > near_enough_m && at_high > at_low; ++step) {
    const double middle = (low * at_high - high * at_low) / (at_high - at_low);
    const double at_middle = nearer_by(middle);
    if (std::abs(at_middle) < near_enough_m * cosine_) return middle;
    const int side = at_middle > 0.0 ? 1 : -1;
    if (side > 0) {
      high = middle;
      at_high = at_middle;
      if (last_side == side) at_low *= 0.5;
    } else {
      low = middle;
      at_low = at_middle;
      if (last_side == side) at_high *= 0.5;
    }
    last_side = side;
  }
  return 0.5 * (low + high);
}

}  // namespace sigmascape::bake
