#include "sigmascape/atlas/ground_layers.h"

#include <filesystem>
#include <system_error>
#include <utility>

#include "sigmascape/atlas/building_file.h"
#include "sigmascape/atlas/obstacle_file.h"
#include "sigmascape/atlas/stac_catalog.h"
#include "sigmascape/atlas/texture_file.h"
#include "sigmascape/base/error.h"
#include "sigmascape/geo/atomic_file.h"

namespace sigmascape::atlas {
namespace {

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

AtlasDescription ground_description(const Store& atlas, const std::vector<double>& elevations_rad) {
  AtlasDescription description = atlas.description();
  description.name += ", ground alone";
  description.aspects = {{0.0}, elevations_rad, atlas.description().aspects.frequencies_hz};
  description.settings = {{layer_setting, "ground without what stands on it, from any azimuth"}};
  if (atlas.description().settings.contains(physics_revision_setting))
    description.settings[physics_revision_setting] = atlas.description().physics_revision();
  return description;
}

/// As faults of an atlas name it.
std::filesystem::path collection_of_ground() {
  return std::filesystem::path(ground_folder) / collection_name;
}

/// What is wrong with the collection in a folder, if there is one, that should say this.
std::optional<StoreFault> fault_against(const std::filesystem::path& folder, const AtlasDescription& description) {
  try {
    static_cast<void>(Store::find(folder, description));
    return std::nullopt;
  } catch (const Error&) {
    return StoreFault{collection_of_ground(), "was altered: it does not say what follows from the atlas"};
  }
}

}  // namespace

bool is_ground_of_an_atlas(const AtlasDescription& description) {
  return description.settings.contains(layer_setting);
}

bool keeps_ground_apart(const AtlasDescription& description) {
  const auto setting = description.settings.find(shadows_setting);
  return setting != description.settings.end() && setting->second == shadows_at_run_time;
}

radar::FromAfar from_afar(const AtlasDescription& description) {
  const auto footing = description.settings.find(footing_setting);
  const bool on_terrain = footing != description.settings.end() && footing->second == footing_on_terrain;
  return on_terrain ? radar::FromAfar::Unhidden : radar::FromAfar::Hidden;
}

Store create_ground_store(const Store& atlas, const std::vector<double>& elevations_rad,
                          std::vector<StoreFault>* mended) {
  const AtlasDescription description = ground_description(atlas, elevations_rad);
  const std::filesystem::path folder = ground_folder_of(atlas);
  if (const auto fault = fault_against(folder, description)) {
    geo::write_atomically(folder / collection_name, collection_text(description));
    if (mended != nullptr) mended->push_back(*fault);
  }
  return Store::create(folder, description);
}

std::optional<StoreFault> ground_collection_fault(const Store& atlas) {
  const std::filesystem::path folder = ground_folder_of(atlas);
  try {
    return fault_against(folder, ground_description(atlas, Store::open(folder).description().aspects.elevations_rad));
  } catch (const Error&) {
    const std::error_code error = text_of(folder / collection_name).error;
    if (is_nothing_there(error)) return StoreFault{collection_of_ground(), "is missing"};
    return StoreFault{collection_of_ground(), error ? cannot_be_read(error) : "is truncated or was altered"};
  }
}

std::filesystem::path ground_folder_of(const Store& atlas) {
  return atlas.folder() / ground_folder;
}

Store open_ground_store(const Store& atlas) {
  return Store::open(ground_folder_of(atlas));
}

GroundLayers load_ground_layers(const Store& atlas, const LoadOptions& options) {
  const Store ground = open_ground_store(atlas);
  radar::ObstacleMap obstacles = load_obstacles(atlas);
  radar::AnsweringTops tops = radar::answering_tops(obstacles, from_afar(atlas.description()));
  return {load_atlas(ground, {.finest_level = options.finest_level,
                              .threads = options.threads,
                              .aspects = {},
                              .reading = options.reading}),
          std::move(obstacles), std::move(tops),
          keeps_buildings_apart(atlas.description()) ? std::optional(read_buildings(atlas)) : std::nullopt};
}

}  // namespace sigmascape::atlas
