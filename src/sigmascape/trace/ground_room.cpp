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

}  // namespace

void require_room(const scene::Scene& scene, const radar::Rectangle& part, double memory_bytes) {
  const terrain::HeightField& field = scene.terrain;
  const auto of_materials = static_cast<double>(scene.ground.material.size() * sizeof(scene::MaterialIndex));
  const double of_heights = static_cast<double>(field.height_m.size() * sizeof(float)) +
                            static_cast<double>(heights_within(field, part)) * bytes_a_height;
  const double bytes = of_materials + of_heights;
  if (bytes <= memory_bytes) return;
  if (of_materials > 0.5 * memory_bytes) {
    const radar::GroundGrid& cells = scene.ground.grid;
    throw Error(
        scene.name,
        fmt::format("its {} × {} cells of land cover of {:g} m take {:.3g} GB of memory, and there are {:.3g} for "
                    "the ground",
                    cells.columns, cells.rows, cells.cell_m, of_materials / 1e9, memory_bytes / 1e9),
        fmt::format("choose a cell_m of {:g} or more in [land_cover], or a smaller extent",
                    terrain::fitting_spacing_m(cells.cell_m, of_materials, 0.5 * memory_bytes)));
  }
  throw Error(
      scene.name,
      fmt::format("its {} × {} heights every {:g} m and what rays need over them take {:.3g} GB of memory, and "
                  "there are {:.3g}",
                  field.height_m.columns(), field.height_m.rows(), field.spacing_m, bytes / 1e9, memory_bytes / 1e9),
      fmt::format("choose a spacing_m of {:g} or more in [terrain], or a smaller extent; maps from an atlas, at "
                  "level of detail 1 and up, trace no rays",
                  terrain::fitting_spacing_m(field.spacing_m, of_heights, memory_bytes - of_materials)));
}

}  // namespace sigmascape::trace
