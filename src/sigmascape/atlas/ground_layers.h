#pragma once

#include <filesystem>
#include <optional>
#include <string_view>
#include <vector>

#include "sigmascape/atlas/atlas.h"
#include "sigmascape/atlas/buildings.h"
#include "sigmascape/atlas/store.h"
#include "sigmascape/radar/answering_tops.h"
#include "sigmascape/radar/obstacle.h"

namespace sigmascape::atlas {

/// The bare ground apart from what stands on it. Its shadows are then made when a map is rendered, and the textures of
/// the atlas hold all echoes but the ground's direct one. docs/decisions/0006-ground-apart.md.
struct GroundLayers {
  Atlas sigma0;  ///< of the level ground if nothing stood on it: one azimuth stands for all
  radar::ObstacleMap obstacles;
  radar::AnsweringTops answering_tops;  ///< of those obstacles
  /// Where they are kept apart too, and their direct echoes not in the textures; they are obstacles all the same.
  std::optional<Buildings> buildings = {};
};

/// The setting of a store whose ground is kept apart, and what it says then.
inline constexpr const char* shadows_setting = "shadows";
inline constexpr const char* shadows_at_run_time = "run-time";

/// What objects stood on when they were baked, and what it says then.
inline constexpr const char* footing_setting = "footing";
inline constexpr const char* footing_on_terrain = "terrain";

[[nodiscard]] bool keeps_ground_apart(const AtlasDescription& description);
[[nodiscard]] inline bool keeps_ground_apart(const Store& store) {
  return keeps_ground_apart(store.description());
}

/// What becomes of what its textures hold of echoes from afar where terrain hides the ground.
[[nodiscard]] radar::FromAfar from_afar(const AtlasDescription& description);

/// The store, in the folder `ground` of an atlas, of the ground's own σ0: the same patches and frequencies, azimuth 0
/// and these elevations. Made when it is not there; a collection that says something else, or nothing, is written anew,
/// since it follows from the atlas, and added to `mended`.
[[nodiscard]] Store create_ground_store(const Store& atlas, const std::vector<double>& elevations_rad,
                                        std::vector<StoreFault>* mended = nullptr);

/// What is wrong with the collection of the ground's store, if anything: by itself, and held against the atlas.
[[nodiscard]] std::optional<StoreFault> ground_collection_fault(const Store& atlas);

inline constexpr std::string_view ground_folder = "ground";
[[nodiscard]] std::filesystem::path ground_folder_of(const Store& atlas);
/// Throws Error when there is none.
[[nodiscard]] Store open_ground_store(const Store& atlas);

/// Throws Error when a part is missing or not as it should be.
[[nodiscard]] GroundLayers load_ground_layers(const Store& atlas, const LoadOptions& options);

}  // namespace sigmascape::atlas
