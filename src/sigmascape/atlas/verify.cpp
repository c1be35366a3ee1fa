#include "sigmascape/atlas/verify.h"

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <utility>

#include "sigmascape/atlas/building_file.h"
#include "sigmascape/atlas/catalogs.h"
#include "sigmascape/atlas/ground_layers.h"
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

std::vector<StoreFault> faults_of_ground(const Store& atlas, Scrutiny scrutiny, ProgressListener* progress) {
  // Without its collection nothing tells what should be there.
  if (auto fault = ground_collection_fault(atlas)) return {std::move(*fault)};
  const auto folder = std::filesystem::relative(ground_folder_of(atlas), atlas.folder());
  std::vector<StoreFault> faults = faults_of_textures(open_ground_store(atlas), scrutiny, progress);
  for (StoreFault& fault : faults) fault.file = folder / fault.file;
  return faults;
}

}  // namespace

std::vector<StoreFault> verify(const Store& atlas, Scrutiny scrutiny, ProgressListener* progress) {
  std::vector<StoreFault> faults = faults_of_textures(atlas, scrutiny, progress);
  if (!is_ground_of_an_atlas(atlas.description())) {
    if (auto fault = terrain_fault(atlas, scrutiny)) faults.push_back(std::move(*fault));
  }
  if (keeps_buildings_apart(atlas.description())) {
    if (auto fault = buildings_fault(atlas, scrutiny)) faults.push_back(std::move(*fault));
  }
  if (!keeps_ground_apart(atlas)) return faults;
  std::ranges::move(faults_of_ground(atlas, scrutiny, progress), std::back_inserter(faults));
  for (const PatchIndex& patch : atlas.description().patches.covering(atlas.description().extent)) {
    if (auto fault = obstacles_fault(atlas, patch, scrutiny)) faults.push_back(std::move(*fault));
  }
  std::ranges::move(obstacle_pyramid(atlas).verify(scrutiny), std::back_inserter(faults));
  return faults;
}

}  // namespace sigmascape::atlas
