#include "sigmascape/atlas/verify.h"

#include <algorithm>
#include <iterator>
#include <optional>
#include <string_view>
#include <utility>

#include "sigmascape/atlas/building_file.h"
#include "sigmascape/atlas/building_textures.h"
#include "sigmascape/atlas/catalogs.h"
#include "sigmascape/atlas/ground_layers.h"
#include "sigmascape/atlas/layer_store.h"
#include "sigmascape/atlas/obstacle_file.h"
#include "sigmascape/atlas/pyramid.h"
#include "sigmascape/atlas/terrain_file.h"

namespace sigmascape::atlas {
namespace {

std::vector<StoreFault> faults_of_textures(const Store& store, Scrutiny scrutiny, ProgressListener* progress) {
  std::vector<StoreFault> faults = catalog_faults(store, scrutiny);
  std::ranges::move(store.verify(scrutiny, progress), std::back_inserter(faults));
  std::ranges::move(Pyramid(store).verify(scrutiny), std::back_inserter(faults));
  return faults;
}

/// Of a layer of the atlas, in a folder of it, whose collection has that fault.
std::vector<StoreFault> faults_of_layer(const Store& atlas, std::string_view folder,
                                        std::optional<StoreFault> of_collection, Scrutiny scrutiny,
                                        ProgressListener* progress) {
  // Without its collection nothing tells what should be there.
  if (of_collection) return {*std::move(of_collection)};
  std::vector<StoreFault> faults = faults_of_textures(Store::open(atlas.folder() / folder), scrutiny, progress);
  for (StoreFault& fault : faults) fault.file = folder / fault.file;
  return faults;
}

}  // namespace

std::vector<StoreFault> verify(const Store& atlas, Scrutiny scrutiny, ProgressListener* progress) {
  std::vector<StoreFault> faults = faults_of_textures(atlas, scrutiny, progress);
  if (!is_layer_of_an_atlas(atlas.description())) {
    if (auto fault = terrain_fault(atlas, scrutiny)) faults.push_back(std::move(*fault));
  }
  if (keeps_buildings_apart(atlas.description())) {
    if (auto fault = buildings_fault(atlas, scrutiny)) faults.push_back(std::move(*fault));
  }
  const auto add_layer = [&](std::string_view folder, std::optional<StoreFault> of_collection) {
    std::ranges::move(faults_of_layer(atlas, folder, std::move(of_collection), scrutiny, progress),
                      std::back_inserter(faults));
  };
  if (keeps_building_textures(atlas.description())) add_layer(building_textures_folder, building_textures_fault(atlas));
  if (!keeps_ground_apart(atlas)) return faults;
  add_layer(ground_folder, ground_collection_fault(atlas));
  for (const PatchIndex& patch : atlas.description().patches.covering(atlas.description().extent)) {
    if (auto fault = obstacles_fault(atlas, patch, scrutiny)) faults.push_back(std::move(*fault));
  }
  std::ranges::move(obstacle_pyramid(atlas).verify(scrutiny), std::back_inserter(faults));
  return faults;
}

}  // namespace sigmascape::atlas
