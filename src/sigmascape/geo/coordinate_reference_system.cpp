#include "sigmascape/geo/coordinate_reference_system.h"

#include "sigmascape/geo/gdal_memory_file.h"
#include "sigmascape/geo/geotiff_encoding.h"
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

void require_geotiff_keys(const std::string& crs, const std::string& where) {
  const QuietGdal quiet;
  const auto one_cell = floats_in_memory(where, 1, 1, 1, {0.0, 0.0, 1.0, crs}, {});
  const GdalMemoryFile file;
  encode_geotiff(where, *one_cell, {}, file);
}

}  // namespace sigmascape::geo
