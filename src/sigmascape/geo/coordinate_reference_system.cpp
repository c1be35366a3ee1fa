#include "sigmascape/geo/coordinate_reference_system.h"

#include "sigmascape/geo/spatial_reference.h"

namespace sigmascape::geo {

bool is_in_degrees(const std::string& crs) {
  return reference_from(crs, "CRS").IsGeographic() != 0;
}

std::string wkt2_from(const std::string& crs) {
  return wkt2_from(reference_from(crs, "CRS"));
}

}  // namespace sigmascape::geo
