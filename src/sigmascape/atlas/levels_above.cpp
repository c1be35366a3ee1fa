#include "sigmascape/atlas/levels_above.h"

#include <filesystem>

#include "sigmascape/atlas/catalogs.h"
#include "sigmascape/atlas/ground_layers.h"
#include "sigmascape/atlas/obstacle_file.h"
#include "sigmascape/atlas/pyramid.h"

namespace sigmascape::atlas {

namespace {

/// σ0 and what leads to it.
LevelsAbove make_levels_of(const Store& store, Scrutiny scrutiny) {
  const Pyramid pyramid(store);
  const auto patches = store.description().patches.covering(store.description().extent);
  LevelsAbove made;
  for (LookIndex look = 0; look < store.description().aspects.look_count(); ++look) {
    MakingNotes notes;
    const std::size_t written = pyramid.make_above(patches, look, scrutiny, &notes);
    made += {written, notes.left_out.size(), pyramid.hindrances(notes.left_out, look)};
  }
  mend_catalogs(store, scrutiny);
  return made;
}

LevelsAbove make_levels_of_obstacles(const Store& atlas, Scrutiny scrutiny) {
  const LayerPyramid pyramid = obstacle_pyramid(atlas);
  const auto patches = atlas.description().patches.covering(atlas.description().extent);
  MakingNotes notes;
  const std::size_t written = pyramid.make_above(patches, scrutiny, &notes);
  return {written, notes.left_out.size(), pyramid.hindrances(notes.left_out)};
}

LevelsAbove make_levels_of_ground(const Store& atlas, Scrutiny scrutiny) {
  const std::filesystem::path folder = ground_folder_of(atlas);
  if (!std::filesystem::exists(folder)) return {};
  LevelsAbove made = make_levels_of(open_ground_store(atlas), scrutiny);
  for (StoreFault& fault : made.hindrances) fault.file = folder.filename() / fault.file;
  return made;
}

}  // namespace

LevelsAbove& LevelsAbove::operator+=(const LevelsAbove& other) {
  written += other.written;
  left_out += other.left_out;
  hindrances.insert(hindrances.end(), other.hindrances.begin(), other.hindrances.end());
  return *this;
}

LevelsAbove make_levels_above(const Store& atlas, Scrutiny scrutiny) {
  LevelsAbove made = make_levels_of(atlas, scrutiny);
  if (!keeps_ground_apart(atlas)) return made;
  made += make_levels_of_obstacles(atlas, scrutiny);
  made += make_levels_of_ground(atlas, scrutiny);
  return made;
}

}  // namespace sigmascape::atlas
