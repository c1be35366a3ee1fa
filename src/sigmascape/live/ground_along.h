#pragma once

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "sigmascape/base/vec.h"
#include "sigmascape/radar/curved_earth.h"
#include "sigmascape/radar/distance_of_range.h"
#include "sigmascape/radar/look.h"

namespace sigmascape::live {

/// No ground that is farther away along the sea is of that range, for none lies lower than the bottom of the sea.
[[nodiscard]] inline double farthest_ground_m(const radar::CurvedEarth& earth, double range_m) {
  constexpr double for_depths = 1.02;
  return for_depths * radar::distance_of_range_m(earth, 0.0, 0.0, range_m);
}

/// How far below a radar the ground lies along one azimuth, at growing slant ranges up to a last one. Heights are asked
/// for at distances that ground of that range may have, and at none beyond (`reach_m`).
/// `Height`: of the ground above mean sea level, of a place of the local frame.
template <typename Height>
class GroundAlong {
 public:
  GroundAlong(Vec3d radar, double azimuth_rad, double last_range_m, const Height& height_m,
              const radar::CurvedEarth& earth)
      : radar_(radar),
        foot_{radar.x, radar.y},
        outwards_(radar::horizontal_direction(azimuth_rad)),
        height_m_(height_m),
        earth_(earth),
        here_(nearest(last_range_m)) {}

  /// As of radar::Echo. Where ground lies over other ground any of its places will do: they differ by no more than
  /// their heights over the range.
  double sin_depression(double range_m) {
    here_ = next(here_, range_m);
    // The law of cosines over the enlarged Earth (docs/physics/curved_earth.md, Eq. (4)), solved for the angle at the
    // radar.
    const double c = earth_.curvature_per_m(), above_m = radar_.z - here_.height_m;
    const double sine = (c * here_.range_m * here_.range_m + above_m * (2.0 + c * (radar_.z + here_.height_m))) /
                        (2.0 * range_m * (1.0 + c * radar_.z));
    return std::clamp(sine, -1.0, 1.0);
  }

 private:
  /// A depression angle is good to so many radians where slopes are no steeper than 45°.
  static constexpr double near_enough_rad = 2e-6;

  /// On the ground.
  struct Place {
    double distance_m, height_m, range_m;
  };

  [[nodiscard]] Place at(double distance_m) const {
    const double height_m = height_m_(foot_ + outwards_ * distance_m);
    return {distance_m, height_m, earth_.slant_range_m(radar_.z, height_m, distance_m)};
  }

  /// Where the ground is nearest: straight below, unless it rises ahead by more than it recedes.
  [[nodiscard]] Place nearest(double last_range_m) const {
    constexpr int places = 64;
    const Place below = at(0.0);
    Place nearest = below;
    const double farthest_m = std::min(below.range_m, farthest_ground_m(earth_, last_range_m));
    for (int number = 1; number < places; ++number) {
      const Place there = at(farthest_m * number / places);
      if (there.range_m < nearest.range_m) nearest = there;
    }
    return nearest;
  }

  /// A place of that range beyond one of less; that one where it is no less. However steep the ground, one lies between
  /// it and whatever is farther away, whereas height and distance found from each other in turn run off at steep looks.
  [[nodiscard]] Place next(Place near, double wanted_m) const {
    if (near.range_m >= wanted_m) return near;
    const double near_enough_m = near_enough_rad * wanted_m;
    Place far = at(std::max(radar::distance_of_range_m(earth_, radar_.z, near.height_m, wanted_m),
                            near.distance_m + near_enough_m));
    if (far.range_m < wanted_m - near_enough_m) std::tie(near, far) = about(near, far, wanted_m, near_enough_m);
    return between(near, far, wanted_m, near_enough_m);
  }

  /// The last two of steps from one place over another until there is ground of that range: twice as far beyond as an
  /// even slope would have it, and farther from there.
  [[nodiscard]] std::pair<Place, Place> about(Place near, Place far, double wanted_m, double near_enough_m) const {
    const double farthest_m = farthest_ground_m(earth_, wanted_m);
    const double farther_m = far.range_m - near.range_m, way_m = far.distance_m - near.distance_m;
    double step_m = farther_m > 0.0 ? 2.0 * (wanted_m - far.range_m) / farther_m * way_m : 2.0 * way_m;
    for (; far.range_m < wanted_m - near_enough_m && far.distance_m < farthest_m; step_m *= 2.0) {
      near = far;
      far = at(std::min(far.distance_m + step_m, farthest_m));
    }
    return {near, far};
  }

  /// Regula falsi in its Illinois form.
  [[nodiscard]] Place between(const Place& near, const Place& far, double wanted_m, double near_enough_m) const {
    constexpr int most_steps = 40;
    double near_m = near.distance_m, far_m = far.distance_m;
    // By how much the two are farther away than is wanted.
    double near_by_m = near.range_m - wanted_m, far_by_m = far.range_m - wanted_m;
    if (far_by_m < near_enough_m) return far;
    int last_side = 0;
    for (int step = 0; step < most_steps && far_m - near_m > near_enough_m; ++step) {
      const Place middle = at((near_m * far_by_m - far_m * near_by_m) / (far_by_m - near_by_m));
      const double middle_by_m = middle.range_m - wanted_m;
      if (std::abs(middle_by_m) < near_enough_m) return middle;
      const int side = middle_by_m > 0.0 ? 1 : -1;
      (side > 0 ? far_m : near_m) = middle.distance_m;
      (side > 0 ? far_by_m : near_by_m) = middle_by_m;
      if (side == last_side) (side > 0 ? near_by_m : far_by_m) *= 0.5;
      last_side = side;
    }
    return at(0.5 * (near_m + far_m));
  }

  Vec3d radar_;
  Vec2d foot_, outwards_;
  const Height& height_m_;
  radar::CurvedEarth earth_;
  Place here_;  // of the range before, where the search for the next begins
};

}  // namespace sigmascape::live
