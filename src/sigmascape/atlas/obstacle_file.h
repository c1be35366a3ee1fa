#pragma once

#include <filesystem>
#include <optional>

#include "sigmascape/atlas/layer_pyramid.h"
#include "sigmascape/atlas/store.h"
#include "sigmascape/atlas/texture_file.h"
#include "sigmascape/base/array2d.h"
#include "sigmascape/radar/obstacle.h"

namespace sigmascape::atlas {

/// What stands on the ground of an atlas that keeps it apart, at rest: `obstacles.tif` in the folder of each patch, on
/// the texels of all its levels, each next level made by radar::merged, and in the folders of the pyramid above the
/// patches. docs/decisions/0115-obstacles-in-levels.md.

/// Of a patch (level 0) or a place above; relative to the store.
[[nodiscard]] std::filesystem::path obstacles_path(const PyramidTile& tile);

/// What is wrong with obstacles that are stored without coarser levels, as 32-bit floats.
inline constexpr const char* obstacles_of_a_former_kind = "is of a former kind, without coarser levels";

/// Such a file (relative to the store) as it was found.
[[nodiscard]] FoundTexture found_obstacles(const Store& atlas, const std::filesystem::path& file, Scrutiny scrutiny);
/// What is wrong with the obstacles of a patch, if anything.
[[nodiscard]] std::optional<StoreFault> obstacles_fault(const Store& atlas, PatchIndex patch, Scrutiny scrutiny);

/// Writes what stands on a patch, given on the texels of its level 0, with all levels, its item beside it. Throws Error
/// when the raster has another size, holds what is negative or not finite, or cannot be written.
void write_obstacles(const Store& atlas, PatchIndex patch, const radar::ObstacleMap& map);

/// What stands on a patch, [column, row] of its level 0, north up. Throws Error when the file is missing or not as it
/// should be.
[[nodiscard]] Array2D<radar::Obstacle> read_obstacles(const Store& atlas, PatchIndex patch);

/// The levels above the patches, where those that the atlas does not have count as nothing standing. Keeps a reference.
[[nodiscard]] LayerPyramid obstacle_pyramid(const Store& atlas);

}  // namespace sigmascape::atlas
