#include "sigmascape/geo/spatial_reference.h"

#include <array>
#include <cpl_conv.h>
#include <fmt/format.h>

#include "sigmascape/base/error.h"
#include "sigmascape/geo/quiet_gdal.h"

namespace sigmascape::geo {

OGRSpatialReference reference_from(const std::string& crs, const std::string& where) {
  const QuietGdal quiet;
  OGRSpatialReference reference;
  reference.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
  if (crs.empty() || reference.SetFromUserInput(crs.c_str()) != OGRERR_NONE) {
    throw Error(where, fmt::format("the coordinate reference system '{}' is not known", crs.substr(0, 60)),
                "give an authority code such as EPSG:25830, a PROJ string or WKT");
  }
  return reference;
}

std::string wkt2_from(const OGRSpatialReference& reference) {
  const QuietGdal quiet;
  char* text = nullptr;
  const std::array<const char*, 3> options{"FORMAT=WKT2_2019", "MULTILINE=NO", nullptr};
  const bool failed = reference.exportToWkt(&text, options.data()) != OGRERR_NONE;
  std::string wkt = text == nullptr ? "" : text;
  CPLFree(text);
  if (failed) throw Error("CRS", "cannot be expressed as WKT", "use another CRS");
  return wkt;
}

}  // namespace sigmascape::geo
