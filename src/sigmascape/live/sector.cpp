#include "sigmascape/live/sector.h"

#include <algorithm>
#include <cmath>

#include "sigmascape/base/units.h"
#include "sigmascape/base/vec.h"
#include "sigmascape/radar/look.h"
#include "sigmascape/radar/rectangle_parts.h"

namespace sigmascape::live {
namespace {

/// Cuts a stretch down to where a · x + b ≥ 0.
void keep_positive(Sector::Stretch& stretch, double a, double b) {
  if (a > 0.0) {
    stretch.west_m = std::max(stretch.west_m, -b / a);
  } else if (a < 0.0) {
    stretch.east_m = std::min(stretch.east_m, -b / a);
  } else if (b < 0.0) {
    stretch.east_m = stretch.west_m;
  }
}

}  // namespace

Sector::Sector(double first_azimuth_rad, double width_rad, double near_m, double far_m, double margin_m)
    : first_azimuth_rad_(first_azimuth_rad),
      width_rad_(width_rad),
      near_m_(std::max(near_m - margin_m, 0.0)),
      far_m_(far_m + margin_m),
      margin_m_(margin_m),
      left_(radar::horizontal_direction(first_azimuth_rad)),
      right_(radar::horizontal_direction(first_azimuth_rad + width_rad)),
      middle_(radar::horizontal_direction(first_azimuth_rad + 0.5 * width_rad)) {}

Sector::Stretches Sector::along_row(double north_m) const {
  Stretches stretches;
  const double outer = far_m_ * far_m_ - north_m * north_m;
  if (outer <= 0.0) return stretches;
  Stretch whole{-std::sqrt(outer), std::sqrt(outer)};
  // Right of the left edge and left of the right edge.
  keep_positive(whole, left_.y, margin_m_ - left_.x * north_m);
  keep_positive(whole, -right_.y, margin_m_ + right_.x * north_m);
  // So far beside them, the edges meet far behind the radar.
  if (margin_m_ > 0.0) keep_positive(whole, middle_.x, margin_m_ + middle_.y * north_m);
  if (whole.east_m <= whole.west_m) return stretches;

  const double inner = near_m_ * near_m_ - north_m * north_m;
  if (inner <= 0.0) {
    stretches.of[stretches.count++] = whole;
    return stretches;
  }
  const double reach = std::sqrt(inner);
  for (const Stretch part :
       {Stretch{whole.west_m, std::min(whole.east_m, -reach)}, Stretch{std::max(whole.west_m, reach), whole.east_m}}) {
    if (part.east_m > part.west_m) stretches.of[stretches.count++] = part;
  }
  return stretches;
}

radar::Rectangle Sector::bounds() const {
  radar::Rectangle box{1e300, 1e300, -1e300, -1e300};
  const auto include = [&box](double azimuth_rad, double distance_m) {
    box = radar::with_point(box, radar::horizontal_direction(azimuth_rad) * distance_m);
  };
  for (const double azimuth : {first_azimuth_rad_, first_azimuth_rad_ + width_rad_}) {
    include(azimuth, near_m_);
    include(azimuth, far_m_);
  }
  // The outer arc bulges out where it crosses north, east, south or west.
  for (double crossing = std::ceil(first_azimuth_rad_ / (pi / 2.0)) * (pi / 2.0);
       crossing < first_azimuth_rad_ + width_rad_; crossing += pi / 2.0) {
    include(crossing, far_m_);
  }
  // Along a diagonal the margin reaches farther than its width.
  return radar::widened(box, 2.0 * margin_m_);
}

}  // namespace sigmascape::live
