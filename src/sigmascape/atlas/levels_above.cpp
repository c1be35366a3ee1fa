#include "sigmascape/atlas/levels_above.h"

#include <filesystem>

#include "sigmascape/atlas/ground_layers.h"
#include "sigmascape/atlas/obstacle_file.h"
#include "sigmascape/atlas/pyramid.h"

namespace sigmascape::atlas {

std::size_t make_levels_above(const Store& atlas, Scrutiny scrutiny) {
  std::size_t written = Pyramid(atlas).make_above(atlas.units(), scrutiny);
  if (!keeps_ground_apart(atlas)) return written;
  written +=
      obstacle_pyramid(atlas).make_above(atlas.description().patches.covering(atlas.description().extent), scrutiny);
  if (!std::filesystem::exists(ground_folder_of(atlas))) return written;
  const Store ground = open_ground_store(atlas);
  return written + Pyramid(ground).make_above(ground.units(), scrutiny);
}

}  // namespace sigmascape::atlas
