#include "sigmascape/atlas/ground_layers.h"

#include <array>
#include <filesystem>
#include <fmt/format.h>
#include <system_error>

#include "sigmascape/atlas/stac.h"
#include "sigmascape/atlas/texture_file.h"
#include "sigmascape/atlas/texture_name.h"
#include "sigmascape/base/error.h"
#include "sigmascape/base/sha256.h"
#include "sigmascape/geo/atomic_file.h"
#include "sigmascape/geo/geotiff.h"

namespace sigmascape::atlas {
namespace {

constexpr const char* ground_folder = "ground";

struct Layer {
  const char* name;
  float radar::Obstacle::*value;
};
constexpr std::array<Layer, 4> layers{{{"SOLID_TOP_M", &radar::Obstacle::solid_top_m},
                                       {"CROWN_BASE_M", &radar::Obstacle::crown_base_m},
                                       {"CROWN_TOP_M", &radar::Obstacle::crown_top_m},
                                       {"CROWN_EXTINCTION_PER_M", &radar::Obstacle::crown_extinction_per_m}}};

/// Relative to the store, as textures are.
std::filesystem::path obstacles_path(PatchIndex patch) {
  return std::filesystem::path(patch_name(patch)) / "obstacles.tif";
}

radar::ObstacleMap load_obstacles(const Store& atlas) {
  const PatchGrid& grid = atlas.description().patches;
  const auto patches = grid.covering(atlas.description().extent);
  const radar::GroundGrid first = grid.texels_of(patches.front());
  radar::ObstacleMap map{first, {}};
  map.grid.columns *= static_cast<std::size_t>(patches.back().x - patches.front().x + 1);
  map.grid.rows *= static_cast<std::size_t>(patches.front().y - patches.back().y + 1);
  map.obstacles = Array2D<radar::Obstacle>(map.grid.columns, map.grid.rows);
  for (const PatchIndex& patch : patches) {
    const Array2D<radar::Obstacle> obstacles = read_obstacles(atlas, patch);
    const auto first_column = static_cast<std::size_t>(patch.x - patches.front().x) * first.columns;
    const auto first_row = static_cast<std::size_t>(patches.front().y - patch.y) * first.rows;
    for (std::size_t row = 0; row < first.rows; ++row) {
      for (std::size_t column = 0; column < first.columns; ++column) {
        map.obstacles(first_column + column, first_row + row) = obstacles(column, row);
      }
    }
  }
  return map;
}

}  // namespace

bool keeps_ground_apart(const Store& store) {
  const auto setting = store.description().settings.find(shadows_setting);
  return setting != store.description().settings.end() && setting->second == shadows_at_run_time;
}

Store create_ground_store(const Store& atlas, const std::vector<double>& elevations_rad) {
  AtlasDescription description = atlas.description();
  description.name += ", ground alone";
  description.aspects = {{0.0}, elevations_rad, atlas.description().aspects.frequencies_hz};
  description.settings = {{"layer", "ground without what stands on it, from any azimuth"}};
  return Store::create(ground_folder_of(atlas), description);
}

std::optional<StoreFault> obstacles_fault(const Store& atlas, PatchIndex patch, Scrutiny scrutiny) {
  return texture_fault(atlas.folder(), obstacles_path(patch), scrutiny);
}

void write_obstacles(const Store& atlas, PatchIndex patch, const radar::ObstacleMap& map) {
  const auto path = atlas.folder() / obstacles_path(patch);
  const radar::GroundGrid texels = atlas.description().patches.texels_of(patch);
  if (map.grid != texels || map.obstacles.columns() != texels.columns || map.obstacles.rows() != texels.rows) {
    throw Error(path.string(), "is not given on the texels of the patch",
                fmt::format("give {} x {}", texels.columns, texels.rows));
  }
  geo::GeoRaster raster{.placement = {texels.west_m, texels.north_m, texels.cell_m, atlas.description().frame.proj()},
                        .bands = {},
                        .nodata = {},
                        .metadata = {{"SIGMASCAPE_SCENE_HASH", atlas.description().scene_hash}}};
  for (const Layer& layer : layers) {
    geo::NamedBand& band = raster.bands.emplace_back();
    band = {layer.name, Array2D<float>(texels.columns, texels.rows)};
    for (std::size_t i = 0; i < map.obstacles.size(); ++i) {
      band.values.values()[i] = map.obstacles.values()[i].*layer.value;
    }
  }
  // An item of an earlier file must not vouch for the new one.
  std::error_code ignored;
  std::filesystem::remove(item_path(path), ignored);
  geo::write_geotiff(path, raster);
  const TextureRecord record{std::filesystem::file_size(path), sha256_of_file(path)};
  geo::write_atomically(item_path(path), obstacles_item_text(atlas.description(), patch, path, record));
}

Array2D<radar::Obstacle> read_obstacles(const Store& atlas, PatchIndex patch) {
  const auto path = atlas.folder() / obstacles_path(patch);
  if (const auto fault = obstacles_fault(atlas, patch, Scrutiny::Content)) {
    throw Error((atlas.folder() / fault->file).string(), fault->what, bake_again);
  }
  const geo::GeoRaster raster = geo::read_geotiff(path);
  const std::size_t side = atlas.description().patches.texels_per_side;
  if (raster.bands.size() != layers.size() || raster.bands.front().values.columns() != side ||
      raster.bands.front().values.rows() != side) {
    throw Error(path.string(), "does not have four bands of the patch's texels", "remove it and bake again");
  }
  Array2D<radar::Obstacle> obstacles(side, side);
  for (std::size_t layer = 0; layer < layers.size(); ++layer) {
    const auto values = raster.bands[layer].values.values();
    for (std::size_t i = 0; i < obstacles.size(); ++i) obstacles.values()[i].*layers[layer].value = values[i];
  }
  return obstacles;
}

std::filesystem::path ground_folder_of(const Store& atlas) {
  return atlas.folder() / ground_folder;
}

Store open_ground_store(const Store& atlas) {
  return Store::open(ground_folder_of(atlas));
}

GroundLayers load_ground_layers(const Store& atlas, const LoadOptions& options) {
  const Store ground = open_ground_store(atlas);
  return {load_atlas(ground, {.finest_level = options.finest_level, .threads = options.threads, .aspects = {}}),
          load_obstacles(atlas)};
}

}  // namespace sigmascape::atlas
