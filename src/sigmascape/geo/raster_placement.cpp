#include "sigmascape/geo/raster_placement.h"

#include <fmt/format.h>
#include <ogr_spatialref.h>

#include "sigmascape/base/error.h"
#include "sigmascape/geo/quiet_gdal.h"
#include "sigmascape/geo/spatial_reference.h"

namespace sigmascape::geo {

std::array<Vec2d, 4> geographic_corners(const RasterPlacement& placement, std::size_t columns, std::size_t rows) {
  const QuietGdal quiet;
  const double east_m = placement.west_m + placement.cell_m * static_cast<double>(columns);
  const double south_m = placement.north_m - placement.cell_m * static_cast<double>(rows);
  std::array<double, 4> x{placement.west_m, east_m, east_m, placement.west_m};
  std::array<double, 4> y{south_m, south_m, placement.north_m, placement.north_m};
  const OGRSpatialReference local = reference_from(placement.crs, "CRS");
  const OGRSpatialReference geographic = reference_from("OGC:CRS84", "CRS");
  const ReferenceWay way = way_between(local, geographic);
  if (!way || way->Transform(4, x.data(), y.data()) == FALSE) {
    throw Error("raster",
                fmt::format("reaches from {:.6g} to {:.6g} east and {:.6g} to {:.6g} north, which is beyond what its "
                            "CRS \"{}\" has longitudes and latitudes for",
                            placement.west_m, east_m, south_m, placement.north_m, placement.crs.substr(0, 60)),
                "use smaller cells, or place it where its CRS is valid");
  }
  return {Vec2d{x[0], y[0]}, Vec2d{x[1], y[1]}, Vec2d{x[2], y[2]}, Vec2d{x[3], y[3]}};
}

}  // namespace sigmascape::geo
