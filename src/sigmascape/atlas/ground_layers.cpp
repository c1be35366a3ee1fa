#include "sigmascape/atlas/ground_layers.h"

#include <filesystem>
#include <fmt/format.h>
#include <utility>

#include "sigmascape/atlas/building_file.h"
#include "sigmascape/atlas/layer_store.h"
#include "sigmascape/atlas/obstacle_file.h"
#include "sigmascape/atlas/pyramid.h"
#include "sigmascape/base/error.h"
#include "sigmascape/base/interruption.h"
#include "sigmascape/base/machine_memory.h"

namespace sigmascape::atlas {
namespace {

/// Throws Error where the obstacles of all texels, and what of them answers, take more memory than there is.
void check_room(const Store& atlas, const radar::GroundGrid& grid) {
  const double bytes = static_cast<double>(grid.columns) * static_cast<double>(grid.rows) *
                       static_cast<double>(sizeof(radar::Obstacle) + 2 * sizeof(float));
  if (const double memory_bytes = machine_memory_bytes(); bytes > memory_bytes) {
    throw Error(
        atlas.folder().string(),
        fmt::format("keeps what stands on its ground apart, which takes {:.3g} GB of memory, and there are {:.3g}",
                    bytes / 1e9, memory_bytes / 1e9),
        "take live frames, which read what they look at, or an atlas of a smaller area or coarser texels");
  }
}

radar::ObstacleMap load_obstacles(const Store& atlas) {
  const PatchGrid& grid = atlas.description().patches;
  const auto patches = grid.covering(atlas.description().extent);
  const radar::GroundGrid first = grid.texels_of(patches.front());
  radar::ObstacleMap map{first, {}};
  map.grid.columns *= static_cast<std::size_t>(patches.back().x - patches.front().x + 1);
  map.grid.rows *= static_cast<std::size_t>(patches.front().y - patches.back().y + 1);
  check_room(atlas, map.grid);
  map.obstacles = Array2D<radar::Obstacle>(map.grid.columns, map.grid.rows);
  for (const PatchIndex& patch : patches) {
    Interruption::heed();
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

/// Without noise, and the same over wide ground, so that rounding to fewer bits would shift all of it one way: it keeps
/// all of a half's, which take next to no room.
LayerStore layer_of(const Store& atlas, const std::vector<double>& elevations_rad) {
  LayerStore layer{
      ground_folder,
      layer_description(atlas.description(), "ground", "ground without what stands on it, from any azimuth",
                        {{0.0}, elevations_rad, atlas.description().aspects.frequencies_hz})};
  layer.description.mantissa_bits = pyramid_bits;
  if (unread_collection_fault(atlas, ground_folder)) return layer;
  // Former versions kept as many bits of it as of the looks, and what is begun so goes on so.
  const int kept = open_layer_store(atlas, ground_folder).description().mantissa_bits;
  if (kept == atlas.description().mantissa_bits) layer.description.mantissa_bits = kept;
  return layer;
}

}  // namespace

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
  return create_layer_store(atlas, layer_of(atlas, elevations_rad), mended);
}

std::optional<StoreFault> ground_collection_fault(const Store& atlas) {
  if (auto fault = unread_collection_fault(atlas, ground_folder)) return fault;
  return layer_collection_fault(atlas, layer_of(atlas, open_ground_store(atlas).description().aspects.elevations_rad));
}

std::filesystem::path ground_folder_of(const Store& atlas) {
  return atlas.folder() / ground_folder;
}

Store open_ground_store(const Store& atlas) {
  return open_layer_store(atlas, ground_folder);
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
