#include "sigmascape/trace/ground_room.h"

#include <fmt/format.h>

#include "sigmascape/base/error.h"
#include "sigmascape/terrain/fitting_spacing.h"
#include "sigmascape/trace/ground_within.h"

namespace sigmascape::trace {
namespace {

/// What rays need over every height: Embree's vertex of 12 bytes and some 19 of the tree above it, and while these are
/// built the height and its material once more.
constexpr double bytes_a_height = 36.0;

double bytes_of_ground(const scene::Scene& scene) {
  return static_cast<double>(scene.terrain.height_m.size() * sizeof(float) +
                             scene.ground.material.size() * sizeof(scene::MaterialIndex));
}

}  // namespace

void require_room(const scene::Scene& scene, const radar::Rectangle& part, double memory_bytes) {
  const terrain::HeightField& field = scene.terrain;
  const double of_structures = static_cast<double>(heights_within(field, part)) * bytes_a_height,
               bytes = bytes_of_ground(scene) + of_structures;
  if (bytes <= memory_bytes) return;
  throw Error(
      scene.name,
      fmt::format("its {} × {} heights every {:g} m and what rays need over them take {:.3g} GB of memory, and "
                  "there are {:.3g}",
                  field.height_m.columns(), field.height_m.rows(), field.spacing_m, bytes / 1e9, memory_bytes / 1e9),
      fmt::format("choose a spacing_m of {:g} or more in [terrain], or a smaller extent; maps from an atlas, at "
                  "level of detail 1 and up, trace no rays",
                  terrain::fitting_spacing_m(field.spacing_m, bytes, memory_bytes)));
}

}  // namespace sigmascape::trace
