#include "sigmascape/live/ground_sector.h"

#include <algorithm>
#include <cmath>

#include "sigmascape/base/units.h"
#include "sigmascape/live/frame_reach.h"

namespace sigmascape::live {
namespace {

/// Of the circle about a square.
double radius_about(double side_m) {
  return side_m * std::sqrt(0.5);
}

}  // namespace

radar::Rectangle GroundSector::bounds() const {
  return ground_under(radar, first_azimuth_rad, width_rad, {near_m, far_m});
}

bool GroundSector::may_meet(const radar::Rectangle& square) const {
  const double radius_m = radius_about(square.width_m());
  const Vec2d middle = square.centre() - radar;
  const double distance_m = length(middle);
  if (distance_m + radius_m < near_m || distance_m - radius_m > far_m) return false;
  if (distance_m <= radius_m) return true;
  const double half_width = 0.5 * width_rad + std::asin(radius_m / distance_m);
  const double off_middle = wrapped_azimuth(azimuth_of(middle) - first_azimuth_rad - 0.5 * width_rad + pi) - pi;
  return std::abs(off_middle) <= half_width;
}

double GroundSector::squares_met(double side_m) const {
  // All centres that lie no farther from the sector than the circle reaches: those of the ring, and along its two ends.
  const double radius_m = radius_about(side_m);
  const double outer_m = far_m + radius_m, inner_m = std::max(near_m - radius_m, 0.0);
  const double ends_m2 = width_rad < 2.0 * pi ? (2.0 * (far_m - near_m) + pi * radius_m) * radius_m : 0.0;
  return (0.5 * width_rad * (outer_m * outer_m - inner_m * inner_m) + ends_m2) / (side_m * side_m);
}

}  // namespace sigmascape::live
