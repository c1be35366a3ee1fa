#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "sigmascape/atlas/atlas.h"
#include "sigmascape/atlas/store.h"
#include "sigmascape/radar/obstacle.h"

namespace sigmascape::atlas {

/// The bare ground apart from what stands on it. Its shadows are then made when a map is rendered, and the textures of
/// the atlas hold all echoes but the ground's direct one. docs/decisions/0006-ground-apart.md.
struct GroundLayers {
  Atlas sigma0;  ///< of the level ground if nothing stood on it: one azimuth stands for all
  radar::ObstacleMap obstacles;
};

/// The setting of a store whose ground is kept apart, and what it says then.
inline constexpr const char* shadows_setting = "shadows";
inline constexpr const char* shadows_at_run_time = "run-time";

[[nodiscard]] bool keeps_ground_apart(const Store& store);

/// The store, in the folder `ground` of an atlas, of the ground's own σ0: the same patches and frequencies, azimuth 0
/// and these elevations. Made when it is not there.
[[nodiscard]] Store create_ground_store(const Store& atlas, const std::vector<double>& elevations_rad);

/// What is wrong with the obstacles of a patch, if anything.
[[nodiscard]] std::optional<StoreFault> obstacles_fault(const Store& atlas, PatchIndex patch, Scrutiny scrutiny);
/// Writes what stands on a patch, on the texels of its level 0, as `obstacles.tif` in the patch's folder, its item
/// beside it. Throws Error when the raster has another size or cannot be written.
void write_obstacles(const Store& atlas, PatchIndex patch, const radar::ObstacleMap& map);

/// What stands on a patch, [column, row] of its level 0, north up. Throws Error when the file is missing or not as it
/// should be.
[[nodiscard]] Array2D<radar::Obstacle> read_obstacles(const Store& atlas, PatchIndex patch);

[[nodiscard]] std::filesystem::path ground_folder_of(const Store& atlas);
/// Throws Error when there is none.
[[nodiscard]] Store open_ground_store(const Store& atlas);

/// Throws Error when a part is missing or not as it should be.
[[nodiscard]] GroundLayers load_ground_layers(const Store& atlas, const LoadOptions& options);

}  // namespace sigmascape::atlas
