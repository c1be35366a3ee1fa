#include "sigmascape/atlas/levels_above.h"

#include <algorithm>
#include <iterator>
#include <string_view>
#include <utility>

#include "sigmascape/atlas/building_textures.h"
#include "sigmascape/atlas/catalogs.h"
#include "sigmascape/atlas/ground_layers.h"
#include "sigmascape/atlas/layer_store.h"
#include "sigmascape/atlas/obstacle_file.h"
#include "sigmascape/atlas/pyramid.h"

namespace sigmascape::atlas {

namespace {

/// Files above the patches of one store that were written, and what was not.
struct Made {
  std::size_t written = 0, left_out = 0;
  std::vector<StoreFault> hindrances = {};
};

/// σ0 and what leads to it.
Made make_levels_of(const Store& store, Scrutiny scrutiny) {
  const Pyramid pyramid(store);
  const auto patches = store.description().patches.covering(store.description().extent);
  Made made;
  for (LookIndex look = 0; look < store.description().aspects.look_count(); ++look) {
    MakingNotes notes;
    made.written += pyramid.make_above(patches, look, scrutiny, &notes);
    made.left_out += notes.left_out.size();
    std::ranges::move(pyramid.hindrances(notes.left_out, look), std::back_inserter(made.hindrances));
  }
  mend_catalogs(store, scrutiny);
  return made;
}

Made make_levels_of_obstacles(const Store& atlas, Scrutiny scrutiny) {
  const LayerPyramid pyramid = obstacle_pyramid(atlas);
  const auto patches = atlas.description().patches.covering(atlas.description().extent);
  MakingNotes notes;
  const std::size_t written = pyramid.make_above(patches, scrutiny, &notes);
  return {written, notes.left_out.size(), pyramid.hindrances(notes.left_out)};
}

/// Of a layer in that folder of an atlas. One that was lost has none.
Made make_levels_of_layer(const Store& atlas, std::string_view folder, Scrutiny scrutiny) {
  if (auto fault = unread_collection_fault(atlas, folder)) return {.left_out = 1, .hindrances = {*std::move(fault)}};
  Made made = make_levels_of(Store::open(atlas.folder() / folder), scrutiny);
  for (StoreFault& fault : made.hindrances) fault.file = folder / fault.file;
  return made;
}

/// Returns how many files were written.
std::size_t note(Made made, LevelsAbove& levels) {
  levels.left_out += made.left_out;
  std::ranges::move(made.hindrances, std::back_inserter(levels.hindrances));
  return made.written;
}

}  // namespace

LevelsAbove make_levels_above(const Store& atlas, Scrutiny scrutiny) {
  LevelsAbove levels;
  levels.written.looks = note(make_levels_of(atlas, scrutiny), levels);
  if (keeps_building_textures(atlas.description()))
    levels.written.buildings = note(make_levels_of_layer(atlas, building_textures_folder, scrutiny), levels);
  if (!keeps_ground_apart(atlas)) return levels;
  levels.written.obstacles = note(make_levels_of_obstacles(atlas, scrutiny), levels);
  levels.written.ground = note(make_levels_of_layer(atlas, ground_folder, scrutiny), levels);
  return levels;
}

}  // namespace sigmascape::atlas
