#include "sigmascape/geo/spatial_reference.h"

#include <array>
#include <cpl_conv.h>
#include <fmt/format.h>

#include "sigmascape/base/error.h"
#include "sigmascape/geo/local_frame.h"
#include "sigmascape/geo/quiet_gdal.h"

namespace sigmascape::geo {

namespace {

/// PROJ calls "unknown" whatever is given by its parameters alone.
void name_local_frame(OGRSpatialReference& reference, const std::string& crs) {
  const LocalFrame frame(reference.GetProjParm(SRS_PP_LATITUDE_OF_ORIGIN),
                         reference.GetProjParm(SRS_PP_CENTRAL_MERIDIAN));
  if (frame.proj() == crs) reference.SetProjCS(frame.title().c_str());
}

}  // namespace

std::optional<OGRSpatialReference> known_reference(const std::string& crs) {
  const QuietGdal quiet;
  OGRSpatialReference reference;
  reference.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
  if (crs.empty() || reference.SetFromUserInput(crs.c_str()) != OGRERR_NONE) return std::nullopt;
  if (reference.IsProjected() != 0) name_local_frame(reference, crs);
  return reference;
}

OGRSpatialReference reference_from(const std::string& crs, const std::string& where) {
  if (const auto known = known_reference(crs)) return *known;
  throw Error(where, fmt::format("the coordinate reference system '{}' is not known", crs.substr(0, 60)),
              "give an authority code such as EPSG:25830, a PROJ string or WKT");
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

ReferenceWay way_between(const OGRSpatialReference& from, const OGRSpatialReference& to) {
  return ReferenceWay(OGRCreateCoordinateTransformation(&from, &to));
}

}  // namespace sigmascape::geo
