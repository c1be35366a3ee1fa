#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

namespace sigmascape::radar {

/// What the round Earth itself hides from a radar, whether or not anything is known of the ground on the way: no ground
/// lies lower than the sea but what is known to, and so all that stands beyond the sea's horizon is hidden up to the
/// line of sight that touches the sea there (docs/physics/curved_earth.md, Eqs. (3), (3a)).
///
/// A line of sight is named by its slope at the radar, rise over distance, the Earth falling away. Of a flat Earth, and
/// for a radar that stands no higher than that ground, it hides nothing.
class SeaHorizon {
 public:
  /// `lowest_ground_m`: of the terrain that is known; `curvature_per_m`: CurvedEarth::curvature_per_m.
  SeaHorizon(double radar_height_m, double lowest_ground_m, double curvature_per_m) {
    const double above_m = radar_height_m - std::min(lowest_ground_m, 0.0);
    if (!(curvature_per_m > 0.0 && above_m > 0.0)) return;
    distance_m_ = std::sqrt(2.0 * above_m / curvature_per_m);
    slope_ = -std::sqrt(2.0 * above_m * curvature_per_m);
  }

  /// √(2·k·R·H); infinite where there is none.
  [[nodiscard]] double distance_m() const { return distance_m_; }
  /// What the line of sight to something so far away must be steeper than: −√(2·H/(k·R)) beyond the horizon, −∞ before.
  [[nodiscard]] double slope_before(double distance_m) const {
    return distance_m > distance_m_ ? slope_ : -std::numeric_limits<double>::infinity();
  }

 private:
  double distance_m_ = std::numeric_limits<double>::infinity();
  double slope_ = -std::numeric_limits<double>::infinity();
};

}  // namespace sigmascape::radar
