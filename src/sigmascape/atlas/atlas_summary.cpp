#include "sigmascape/atlas/atlas_summary.h"

#include <filesystem>
#include <system_error>
#include <utility>

#include "sigmascape/atlas/building_file.h"
#include "sigmascape/atlas/building_textures.h"
#include "sigmascape/atlas/ground_layers.h"
#include "sigmascape/atlas/layer_store.h"
#include "sigmascape/atlas/obstacle_file.h"
#include "sigmascape/atlas/pyramid.h"
#include "sigmascape/atlas/stac_item.h"
#include "sigmascape/atlas/terrain_file.h"
#include "sigmascape/atlas/texture_file.h"
#include "sigmascape/base/interruption.h"

namespace sigmascape::atlas {
namespace {

std::uint64_t bytes_in(const std::filesystem::path& folder) {
  using Files = std::filesystem::recursive_directory_iterator;
  std::uint64_t bytes = 0;
  std::error_code error;
  // Folders that may not be looked into are left out: atlas::verify names them.
  for (Files files(folder, std::filesystem::directory_options::skip_permission_denied, error);
       !error && files != Files(); files.increment(error)) {
    std::error_code vanished;
    const auto size = files->is_regular_file(vanished) ? files->file_size(vanished) : 0;
    if (!vanished) bytes += size;
  }
  return bytes;
}

void count(bool is_done, AtlasSummary::Files& files) {
  Interruption::heed();
  ++files.planned;
  files.done += is_done ? 1 : 0;
}

/// Of the levels above the patches.
AtlasSummary::Files textures_above(const Store& store) {
  const Pyramid pyramid(store);
  AtlasSummary::Files textures;
  for (std::size_t level = 1; level <= pyramid.levels(); ++level) {
    for (const PyramidTile& tile : pyramid.tiles(level)) {
      const std::size_t looks = store.description().aspects.look_count();
      for (LookIndex look = 0; look < looks; ++look) count(pyramid.is_done(tile, look), textures);
    }
  }
  return textures;
}

AtlasSummary::Files obstacles_of(const Store& atlas) {
  const LayerPyramid pyramid = obstacle_pyramid(atlas);
  AtlasSummary::Files files;
  for (const PyramidTile& patch : pyramid.tiles(0))
    count(!obstacles_fault(atlas, patch.south_west, Scrutiny::Size), files);
  for (std::size_t level = 1; level <= pyramid.levels(); ++level) {
    for (const PyramidTile& tile : pyramid.tiles(level)) count(pyramid.is_done(tile), files);
  }
  return files;
}

/// Of a layer of an atlas that `open` opens, unless its collection has a fault.
template <typename Open>
AtlasSummary::Layer told_of_layer(const Store& atlas, std::optional<StoreFault> fault, const Open& open) {
  if (fault) return {.textures = {}, .fault = std::move(fault)};
  const Store layer = open(atlas);
  const PatchBlock patches = layer.description().patches.block_over(layer.description().extent);
  const std::size_t looks = layer.description().aspects.look_count();
  AtlasSummary::Files textures = textures_above(layer);
  for (std::size_t number = 0; number < patches.size(); ++number) {
    for (LookIndex look = 0; look < looks; ++look) count(layer.is_done(patches[number], look), textures);
  }
  return {.textures = textures, .fault = std::nullopt};
}

/// Nothing of an atlas that does not keep them apart.
std::optional<AtlasSummary::Buildings> buildings_of(const Store& atlas) {
  if (!keeps_buildings_apart(atlas.description())) return std::nullopt;
  AtlasSummary::Buildings buildings{.fault = buildings_fault(atlas, Scrutiny::Size), .textures = {}};
  if (keeps_building_textures(atlas.description()))
    buildings.textures = told_of_layer(atlas, building_textures_fault(atlas), open_building_textures);
  return buildings;
}

}  // namespace

AtlasSummary summary_of(const Store& store) {
  const AtlasDescription& description = store.description();
  AtlasSummary summary;
  const PatchBlock patches = description.patches.block_over(description.extent);
  const std::size_t look_count = description.aspects.look_count();
  summary.patches = patches.size();
  summary.looks = store.unit_count();
  summary.bytes = bytes_in(store.folder());
  const LookStores stores(store);
  for (std::size_t number = 0; number < summary.looks; ++number) {
    Interruption::heed();
    const PatchIndex patch = patches[number / look_count];
    const auto look = static_cast<LookIndex>(number % look_count);
    if (!stores.is_done(patch, look)) continue;
    const auto record = texture_record(store, store.texture_path(patch, look));
    if (!record) continue;
    ++summary.looks_done;
    summary.bytes_per_look += static_cast<double>(record->size_bytes);
    if (!record->error) continue;
    summary.errors.add(look, *record->error);
    ++summary.looks_told;
  }
  summary.bytes_per_look /= static_cast<double>(std::max<std::size_t>(summary.looks_done, 1));

  summary.pyramid_levels = Pyramid(store).levels();
  summary.pyramid = textures_above(store);
  if (!is_layer_of_an_atlas(store.description())) summary.terrain_fault = terrain_fault(store, Scrutiny::Size);
  summary.buildings = buildings_of(store);
  if (keeps_ground_apart(store)) {
    summary.obstacles = obstacles_of(store);
    summary.ground = told_of_layer(store, ground_collection_fault(store), open_ground_store);
  }
  return summary;
}

}  // namespace sigmascape::atlas
