#include "sigmascape/radar/propagation.h"

#include <cmath>

#include "sigmascape/base/units.h"

namespace sigmascape::radar {

double earth_drop_m(double distance_m, double refraction) {
  return distance_m * distance_m / (2.0 * refraction * earth_radius_m);
}

double horizon_distance_m(double height_m, double refraction) {
  return std::sqrt(2.0 * refraction * earth_radius_m * height_m);
}

double two_way_transmission(double slant_range_m, double db_per_km) {
  return linear_from_db(-2.0 * db_per_km * slant_range_m * 1e-3);
}

}  // namespace sigmascape::radar
