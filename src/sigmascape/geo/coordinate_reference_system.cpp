#include "sigmascape/geo/coordinate_reference_system.h"

#include <array>
#include <fmt/format.h>
#include <gdal_priv.h>
#include <string_view>

#include "sigmascape/base/error.h"
#include "sigmascape/geo/gdal_memory_file.h"
#include "sigmascape/geo/geotiff_encoding.h"
#include "sigmascape/geo/quiet_gdal.h"
#include "sigmascape/geo/spatial_reference.h"

namespace sigmascape::geo {
namespace {

/// Whether two are of the same code of an authority, which decides whatever their names have lost.
bool has_same_code(const OGRSpatialReference& a, const OGRSpatialReference& b) {
  const char *const first = a.GetAuthorityCode(nullptr), *const second = b.GetAuthorityCode(nullptr);
  return first != nullptr && second != nullptr && std::string_view(first) == second;
}

/// Whether programs that open a GeoTIFF come to this system.
bool tells(const GdalMemoryFile& geotiff, const OGRSpatialReference& reference) {
  const GDALDatasetUniquePtr opened(
      GDALDataset::Open(geotiff.name(), GDAL_OF_RASTER | GDAL_OF_READONLY, nullptr, nullptr, nullptr));
  const OGRSpatialReference* told = opened ? opened->GetSpatialRef() : nullptr;
  // In which order programs want numbers is theirs to say; how axes point is the system's.
  const std::array<const char*, 2> options{"IGNORE_DATA_AXIS_TO_SRS_AXIS_MAPPING=YES", nullptr};
  return told != nullptr && (told->IsSame(&reference, options.data()) != 0 || has_same_code(*told, reference));
}

}  // namespace

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
  if (tells(file, reference_from(crs, where))) return;
  throw Error(
      where,
      fmt::format("a GeoTIFF would tell another system than '{}', most likely one of other axes or without its heights",
                  crs),
      "give its authority code such as EPSG:25830, or choose one of axes east and north and without grids");
}

}  // namespace sigmascape::geo
