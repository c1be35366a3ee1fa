#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "sigmascape/base/vec.h"
#include "sigmascape/radar/ground_grid.h"
#include "sigmascape/radar/rectangle_parts.h"

namespace sigmascape::trace {

/// What can matter to paths that begin in a place, wherever it stands: all that is near, and farther away what is tall
/// enough to hide the place from radars that see it no flatter than so.
///
/// A line of sight that meets the ground at height z rises by d · tan ψ over the distance d: a top lower than z + d tan
/// ψ leaves it free. docs/physics/estimator.md, Eq. (15).
struct Surroundings {
  radar::Rectangle place;    ///< where paths begin
  double near_m = 0.0;       ///< from there
  double least_slope = 0.0;  ///< tan ψ of the flattest line of sight; 0 if the place is everything
  double lowest_m = 0.0;     ///< no ground of the place lies lower

  /// All of a scene, however large.
  [[nodiscard]] static constexpr Surroundings everything() {
    constexpr double far = std::numeric_limits<double>::infinity();
    return {.place = {-far, -far, far, far}};
  }

  /// Whether something matters that stands within `radius_m` of a point and whose top is so high.
  [[nodiscard]] bool hold(Vec2d point, double radius_m, double top_m) const {
    const double away_m = distance_m(point) - radius_m;
    return away_m <= near_m || top_m - lowest_m > away_m * least_slope;
  }
  /// Where all stands that matters and is no higher than that.
  [[nodiscard]] radar::Rectangle reach(double top_m) const {
    const double shadow_m = least_slope > 0.0 ? (top_m - lowest_m) / least_slope : 0.0;
    return radar::widened(place, std::max(near_m, shadow_m));
  }

  friend bool operator==(const Surroundings&, const Surroundings&) = default;

 private:
  [[nodiscard]] double distance_m(Vec2d point) const {
    const double east = std::max({place.west_m - point.x, 0.0, point.x - place.east_m});
    const double north = std::max({place.south_m - point.y, 0.0, point.y - place.north_m});
    return std::hypot(east, north);
  }
};

}  // namespace sigmascape::trace
