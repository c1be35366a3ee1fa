#pragma once

#include <limits>

namespace sigmascape::terrain {

/// Walks outwards from an observer along one azimuth and tells which ground rises above all nearer ground.
///
/// Keeps the steepest slope of a line of sight met so far; a point is seen when its own is not below it. Exact along
/// the walked line, in time proportional to its length.
class HorizonSweep {
 public:
  explicit HorizonSweep(double observer_height_m) : observer_height_m_(observer_height_m) {}

  /// Takes the next point outwards; true when it is seen.
  bool advance(double distance_m, double height_m) {
    const double slope = (height_m - observer_height_m_) / distance_m;
    if (slope < steepest_) return false;
    steepest_ = slope;
    return true;
  }

 private:
  double observer_height_m_;
  double steepest_ = -std::numeric_limits<double>::infinity();
};

}  // namespace sigmascape::terrain
