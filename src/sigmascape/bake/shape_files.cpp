#include "sigmascape/bake/shape_files.h"

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <optional>
#include <utility>

#include "sigmascape/atlas/building_file.h"
#include "sigmascape/atlas/terrain_file.h"
#include "sigmascape/bake/buildings_of.h"
#include "sigmascape/terrain/height_field_file.h"
#include "sigmascape/terrain/pyramid_builder.h"
#include "sigmascape/terrain/pyramid_faults.h"
#include "sigmascape/terrain/pyramid_files.h"

namespace sigmascape::bake {
namespace {

std::filesystem::path pyramid_folder(const atlas::Store& store) {
  return store.folder() / atlas::terrain_pyramid_name;
}

/// What is wrong with the terrain's tiles. Those that `sigmascape atlas terrain` made, from a raster, are left as they
/// are; those that a bake made of another scene are not this atlas'. Without a heading that can be understood nothing
/// tells of what heights they are.
std::vector<atlas::StoreFault> pyramid_faults(const scene::Scene& scene, const atlas::Store& store,
                                              atlas::Scrutiny scrutiny) {
  const auto as_of_atlas = [](const terrain::PyramidFault& fault, bool is_absent) {
    return atlas::StoreFault{atlas::terrain_pyramid_name / fault.file, fault.what, is_absent};
  };
  const std::filesystem::path folder = pyramid_folder(store);
  if (const auto fault = terrain::heading_fault(folder)) return {as_of_atlas(*fault, !terrain::holds_pyramid(folder))};
  const geo::LocalFrame& frame = store.description().frame;
  if (!terrain::holds_pyramid_of(folder, scene.terrain, frame)) {
    if (!terrain::holds_pyramid_of_a_field(folder)) return {};
    return {as_of_atlas({terrain::heading_name, "is of other heights than the scene's"}, false)};
  }
  const bool is_read = scrutiny == atlas::Scrutiny::Content;
  const auto found = is_read ? terrain::verify_pyramid(folder, frame) : terrain::missing_files(folder);
  std::vector<atlas::StoreFault> faults;
  for (const terrain::PyramidFault& fault : found) faults.push_back(as_of_atlas(fault, false));
  return faults;
}

std::optional<atlas::StoreFault> write_heights(const scene::Scene& scene, const atlas::Store& store,
                                               atlas::Scrutiny scrutiny) {
  auto fault = atlas::terrain_fault(store, scrutiny);
  if (!fault) return std::nullopt;
  terrain::write_height_field(store.folder() / atlas::terrain_name, scene.terrain, store.description().frame.proj());
  atlas::vouch_for_terrain(store);
  return fault;
}

std::vector<atlas::StoreFault> write_pyramid(const scene::Scene& scene, const atlas::Store& store,
                                             atlas::Scrutiny scrutiny) {
  std::vector<atlas::StoreFault> faults = pyramid_faults(scene, store, scrutiny);
  if (!faults.empty()) terrain::build_pyramid(pyramid_folder(store), scene.terrain, store.description().frame);
  terrain::call_finished(pyramid_folder(store));
  return faults;
}

std::optional<atlas::StoreFault> write_walls_and_roofs(const scene::Scene& scene, const atlas::Store& store,
                                                       atlas::Scrutiny scrutiny) {
  auto fault = atlas::buildings_fault(store, scrutiny);
  if (!fault) return std::nullopt;
  atlas::write_buildings(store, buildings_of(scene, store.description().aspects.frequencies_hz));
  return fault;
}

}  // namespace

std::vector<atlas::StoreFault> write_shape_files(const scene::Scene& scene, const atlas::Store& store,
                                                 bool with_buildings, const Claims& claims, atlas::Scrutiny scrutiny,
                                                 ProgressListener& progress) {
  const bool is_whole = !atlas::terrain_fault(store, scrutiny) && pyramid_faults(scene, store, scrutiny).empty() &&
                        !terrain::is_called_unfinished(pyramid_folder(store)) &&
                        !(with_buildings && atlas::buildings_fault(store, scrutiny));
  if (is_whole) return {};
  // Two at once would take each other's unfinished files for those of other heights.
  const Claims::Claim claim = claims.take(terrain_claim(store.description()), [&progress] {
    progress.waiting("bake", "another process that makes the terrain");
  });
  std::vector<atlas::StoreFault> mended;
  if (auto fault = write_heights(scene, store, scrutiny)) mended.push_back(*std::move(fault));
  std::ranges::move(write_pyramid(scene, store, scrutiny), std::back_inserter(mended));
  if (with_buildings) {
    if (auto fault = write_walls_and_roofs(scene, store, scrutiny)) mended.push_back(*std::move(fault));
  }
  return mended;
}

}  // namespace sigmascape::bake
