#include "sigmascape/geo/coordinate_reference_system.h"

#include "sigmascape/geo/quiet_gdal.h"
#include "sigmascape/geo/spatial_reference.h"

namespace sigmascape::geo {

bool is_in_degrees(const std::string& crs) {
  return reference_from(crs, "CRS").IsGeographic() != 0;
}

bool is_same_crs(const std::string& a, const std::string& b) {
  if (a == b) return true;
  const QuietGdal quiet;
  const auto first = known_reference(a), second = known_reference(b);
  return first && second && first->IsSame(&*second) != 0;
}

std::string wkt2_from(const std::string& crs) {
  return wkt2_from(reference_from(crs, "CRS"));
}

}  // namespace sigmascape::geo
