#include "sigmascape/atlas/levels_above.h"

#include <filesystem>

#include "sigmascape/atlas/catalogs.h"
#include "sigmascape/atlas/ground_layers.h"
#include "sigmascape/atlas/obstacle_file.h"
#include "sigmascape/atlas/pyramid.h"

namespace sigmascape::atlas {

namespace {

/// σ0 and what leads to it.
std::size_t make_levels_of(const Store& store, Scrutiny scrutiny) {
  const Pyramid pyramid(store);
  const auto patches = store.description().patches.covering(store.description().extent);
  std::size_t written = 0;
  for (LookIndex look = 0; look < store.description().aspects.look_count(); ++look) {
    written += pyramid.make_above(patches, look, scrutiny);
  }
  mend_catalogs(store, scrutiny);
  return written;
}

}  // namespace

std::size_t make_levels_above(const Store& atlas, Scrutiny scrutiny) {
  std::size_t written = make_levels_of(atlas, scrutiny);
  if (!keeps_ground_apart(atlas)) return written;
  written +=
      obstacle_pyramid(atlas).make_above(atlas.description().patches.covering(atlas.description().extent), scrutiny);
  if (!std::filesystem::exists(ground_folder_of(atlas))) return written;
  return written + make_levels_of(open_ground_store(atlas), scrutiny);
}

}  // namespace sigmascape::atlas
