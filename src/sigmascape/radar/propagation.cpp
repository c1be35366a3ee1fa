#include "sigmascape/radar/propagation.h"

#include <cmath>

namespace sigmascape::radar {

double earth_drop_m(double distance_m, double refraction) {
  return distance_m * distance_m / (2.0 * refraction * earth_radius_m);
}

double horizon_distance_m(double height_m, double refraction) {
  return std::sqrt(2.0 * refraction * earth_radius_m * height_m);
}

}  // namespace sigmascape::radar
