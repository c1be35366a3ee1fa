#include "sigmascape/product/ground_map_file.h"

#include <utility>

#include "sigmascape/product/map_geotiff.h"

namespace sigmascape::product {
namespace {

radar::GroundMap ground_map_of(MapContent content) {
  return {.grid = content.grid,
          .sigma0 = std::move(content.cells),
          .crs = std::move(content.crs),
          .metadata = std::move(content.metadata)};
}

}  // namespace

radar::GroundMap read_ground_map(const std::filesystem::path& path) {
  return ground_map_of(read_map_geotiff(path, sigma0_quantity()));
}

radar::GroundMap read_ground_map(const std::filesystem::path& path, radar::Polarization polarization) {
  return ground_map_of(read_map_geotiff(path, sigma0_quantity(), polarization));
}

}  // namespace sigmascape::product
