#include "sigmascape/geo/geodesic.h"

#include <cmath>
#include <fmt/format.h>
#include <ogr_spatialref.h>

#include "sigmascape/base/error.h"
#include "sigmascape/geo/quiet_gdal.h"
#include "sigmascape/geo/spatial_reference.h"

namespace sigmascape::geo {

Geodesic geodesic_between(GeographicPosition from, GeographicPosition to) {
  const QuietGdal quiet;
  // That projection has every place at the length and azimuth of its geodesic from the middle.
  const OGRSpatialReference globe = reference_from("EPSG:4326", "position"),
                            about = reference_from(fmt::format("+proj=aeqd +lat_0={:.12f} +lon_0={:.12f} +datum=WGS84 "
                                                               "+units=m +no_defs",
                                                               from.latitude_deg, from.longitude_deg),
                                                   "position");
  const ReferenceWay way = way_between(globe, about);
  double x = to.longitude_deg, y = to.latitude_deg;
  if (!way || way->Transform(1, &x, &y) == 0) {
    throw Error("position",
                fmt::format("no way is known from {:g} N, {:g} E to {:g} N, {:g} E", from.latitude_deg,
                            from.longitude_deg, to.latitude_deg, to.longitude_deg),
                "give places less than half the Earth apart");
  }
  return {std::hypot(x, y), std::atan2(x, y)};
}

}  // namespace sigmascape::geo
