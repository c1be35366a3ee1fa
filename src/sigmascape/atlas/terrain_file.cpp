#include "sigmascape/atlas/terrain_file.h"

#include "sigmascape/atlas/stac_item.h"
#include "sigmascape/atlas/texture_file.h"
#include "sigmascape/base/error.h"
#include "sigmascape/base/sha256.h"
#include "sigmascape/geo/atomic_file.h"
#include "sigmascape/geo/geo_raster.h"

namespace sigmascape::atlas {

void vouch_for_terrain(const Store& atlas) {
  const std::filesystem::path file = atlas.folder() / terrain_name;
  const std::string sha256 = sha256_of_file(file);
  const auto [placement, columns, rows] = geo::read_cells(file);
  geo::write_atomically(
      item_path(file),
      terrain_item_text(atlas.description(), {placement.west_m, placement.north_m, placement.cell_m, columns, rows},
                        {std::filesystem::file_size(file), sha256}));
}

std::optional<StoreFault> terrain_fault(const Store& atlas, Scrutiny scrutiny) {
  return texture_fault(atlas, terrain_name, scrutiny);
}

std::filesystem::path vouched_terrain(const Store& atlas, Scrutiny scrutiny) {
  if (const auto fault = terrain_fault(atlas, scrutiny)) {
    throw Error((atlas.folder() / fault->file).string(), fault->what, bake_again);
  }
  return atlas.folder() / terrain_name;
}

}  // namespace sigmascape::atlas
