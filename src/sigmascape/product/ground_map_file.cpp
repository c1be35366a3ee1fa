#include "sigmascape/product/ground_map_file.h"

#include <utility>

#include "sigmascape/product/map_geotiff.h"

namespace sigmascape::product {

void write_ground_map(const std::filesystem::path& path, const radar::GroundMap& map, MapScale scale) {
  write_map_geotiff(path, view_of(map), scale);
}

radar::GroundMap read_ground_map(const std::filesystem::path& path) {
  MapContent content = read_map_geotiff(path, sigma0_quantity());
  return {.grid = content.grid,
          .sigma0 = std::move(content.cells),
          .crs = std::move(content.crs),
          .metadata = std::move(content.metadata)};
}

}  // namespace sigmascape::product
