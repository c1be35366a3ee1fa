#include "sigmascape/atlas/ground_layers.h"

#include <array>
#include <filesystem>
#include <fmt/format.h>

#include "sigmascape/atlas/texture_name.h"
#include "sigmascape/base/error.h"
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

std::filesystem::path obstacles_path(const Store& atlas, PatchIndex patch) {
  return atlas.folder() / patch_name(patch) / "obstacles.tif";
}

/// Puts one patch's obstacles in their place on the map of all.
void read_obstacles(const Store& atlas, PatchIndex patch, radar::ObstacleMap& map) {
  const auto path = obstacles_path(atlas, patch);
  if (!has_obstacles(atlas, patch)) {
    throw Error(path.string(), "is missing", "finish the bake by starting it again with the same settings");
  }
  const geo::GeoRaster raster = geo::read_geotiff(path);
  const radar::GroundGrid texels = atlas.description().patches.texels_of(patch);
  const Vec2d corner = map.grid.cells_from({texels.west_m + texels.cell_m / 2.0, texels.north_m - texels.cell_m / 2.0});
  const auto first_column = static_cast<std::size_t>(corner.x), first_row = static_cast<std::size_t>(corner.y);
  if (raster.bands.size() != layers.size() || raster.bands.front().values.columns() != texels.columns ||
      raster.bands.front().values.rows() != texels.rows) {
    throw Error(path.string(), "does not have four bands of the patch's texels", "remove it and bake again");
  }
  for (std::size_t layer = 0; layer < layers.size(); ++layer) {
    const Array2D<float>& values = raster.bands[layer].values;
    for (std::size_t row = 0; row < texels.rows; ++row) {
      for (std::size_t column = 0; column < texels.columns; ++column) {
        map.obstacles(first_column + column, first_row + row).*layers[layer].value = values(column, row);
      }
    }
  }
}

radar::ObstacleMap load_obstacles(const Store& atlas) {
  const PatchGrid& grid = atlas.description().patches;
  const auto patches = grid.covering(atlas.description().extent);
  const radar::GroundGrid first = grid.texels_of(patches.front());
  radar::ObstacleMap map{first, {}};
  map.grid.columns *= static_cast<std::size_t>(patches.back().x - patches.front().x + 1);
  map.grid.rows *= static_cast<std::size_t>(patches.front().y - patches.back().y + 1);
  map.obstacles = Array2D<radar::Obstacle>(map.grid.columns, map.grid.rows);
  for (const PatchIndex& patch : patches) read_obstacles(atlas, patch, map);
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
  return Store::create(atlas.folder() / ground_folder, description);
}

bool has_obstacles(const Store& atlas, PatchIndex patch) {
  return std::filesystem::exists(obstacles_path(atlas, patch));
}

void write_obstacles(const Store& atlas, PatchIndex patch, const radar::ObstacleMap& map) {
  const auto path = obstacles_path(atlas, patch);
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
    geo::NamedBand& band = raster.bands.emplace_back(layer.name, Array2D<float>(texels.columns, texels.rows));
    for (std::size_t i = 0; i < map.obstacles.size(); ++i) {
      band.values.values()[i] = map.obstacles.values()[i].*layer.value;
    }
  }
  geo::write_geotiff(path, raster);
}

GroundLayers load_ground_layers(const Store& atlas, const LoadOptions& options) {
  const Store ground = Store::open(atlas.folder() / ground_folder);
  return {load_atlas(ground, {.finest_level = options.finest_level, .threads = options.threads, .aspects = {}}),
          load_obstacles(atlas)};
}

}  // namespace sigmascape::atlas
