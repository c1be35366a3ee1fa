#pragma once

#include "sigmascape/geo/coordinate_transform.h"

namespace sigmascape::geo {

/// The shortest way over the ellipsoid of WGS 84 from one place to another.
struct Geodesic {
  double length_m = 0.0;
  double azimuth_rad = 0.0;  ///< at which it begins, clockwise from true north there
};

[[nodiscard]] Geodesic geodesic_between(GeographicPosition from, GeographicPosition to);

}  // namespace sigmascape::geo
