#include "sigmascape/terrain/height_field_file.h"

#include <utility>

#include "sigmascape/base/error.h"
#include "sigmascape/geo/geo_raster.h"

namespace sigmascape::terrain {
namespace {

constexpr const char* band_name = "HEIGHT_M";

}  // namespace

void write_height_field(const std::filesystem::path& path, const HeightField& field, const std::string& crs) {
  const double half = field.spacing_m / 2.0;
  geo::write_geotiff(path, {.placement = {field.west_m - half, field.north_m + half, field.spacing_m, crs},
                            .bands = {{band_name, field.height_m}},
                            .nodata = {},
                            .metadata = {}});
}

HeightField read_height_field(const std::filesystem::path& path) {
  geo::GeoRaster raster = geo::read_geotiff(path);
  if (raster.bands.size() != 1 || raster.bands.front().name != band_name) {
    throw Error(path.string(), "is not a file of heights", std::string("give one whose only band is ") + band_name);
  }
  const double half = raster.placement.cell_m / 2.0;
  HeightField field;
  field.west_m = raster.placement.west_m + half;
  field.north_m = raster.placement.north_m - half;
  field.spacing_m = raster.placement.cell_m;
  field.height_m = std::move(raster.bands.front().values);
  return field;
}

}  // namespace sigmascape::terrain
