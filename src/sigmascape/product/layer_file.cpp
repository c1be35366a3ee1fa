#include "sigmascape/product/layer_file.h"

#include <limits>

#include "sigmascape/base/error.h"
#include "sigmascape/base/units.h"
#include "sigmascape/geo/geo_raster.h"

namespace sigmascape::product {

void check_layer_name(const std::filesystem::path& path) {
  if (geo::is_geotiff_name(path)) return;
  throw Error(path.string(), "would not be known for a GeoTIFF, which layers are written as", "end the name in .tif");
}

void write_layers(const std::filesystem::path& path, const radar::LayerStack& stack) {
  geo::GeoRaster raster{.placement = {stack.grid.west_m, stack.grid.north_m, stack.grid.cell_m, stack.crs},
                        .bands = {},
                        .nodata = std::numeric_limits<float>::quiet_NaN(),
                        .metadata = stack.metadata};
  for (const radar::Layer& layer : stack.layers) {
    const bool is_angle = layer.unit == "rad", is_mask = layer.unit.empty();
    geo::NamedBand band{.name = layer.name,
                        .values = layer.values,
                        .is_classes = layer.is_classes || is_mask,
                        .unit = is_angle ? "deg" : layer.unit};
    if (is_angle) {
      for (float& value : band.values.values()) value = static_cast<float>(deg_from_radians(value));
    }
    if (!band.unit.empty()) raster.metadata["UNIT_" + layer.name] = band.unit;
    raster.bands.push_back(std::move(band));
  }
  geo::write_geotiff(path, raster);
}

}  // namespace sigmascape::product
