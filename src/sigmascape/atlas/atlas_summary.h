#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "sigmascape/atlas/power_error.h"
#include "sigmascape/atlas/store.h"

namespace sigmascape::atlas {

/// What is there of an atlas on the disk, told from its items without opening a texture.
struct AtlasSummary {
  std::size_t patches = 0;
  std::size_t looks = 0;       ///< (patch, look) pairs that a whole atlas has
  std::size_t looks_done = 0;  ///< of these
  std::size_t pyramid_levels = 0;
  /// Files of one kind that are there as their items say, of those that a whole atlas has.
  struct Files {
    std::size_t done = 0, planned = 0;
  };
  Files pyramid;    ///< textures of looks above the patches
  Files obstacles;  ///< of patches and above them; none are planned where the ground is not kept apart
  /// Textures of the ground's own store, of patches and above them. None is known to be planned where there is a fault
  /// of its collection, which alone tells of its elevations.
  Files ground;
  std::optional<StoreFault> ground_fault = {};   ///< of that collection, where the ground is kept apart
  std::optional<StoreFault> terrain_fault = {};  ///< of `terrain.tif`; its content is not looked at, nor are tiles
  /// Of `buildings.glb`, where buildings are kept apart; its content is not looked at.
  std::optional<StoreFault> buildings_fault = {};
  /// Textures of what buildings return, of patches and above them, where these have such; none is known to be planned
  /// where there is a fault of their collection.
  Files building_textures;
  std::optional<StoreFault> building_textures_fault = {};  ///< of that collection
  std::uint64_t bytes = 0;                                 ///< of everything in the folder
  double bytes_per_look = 0.0;                             ///< mean size of the textures of patches
  /// Of the finest texels of all looks done whose items tell: those of ground do not, nor do those of a former kind.
  PowerErrors errors;
  std::size_t looks_told = 0;  ///< of those done, the ones whose items tell
};

[[nodiscard]] AtlasSummary summary_of(const Store& store);

}  // namespace sigmascape::atlas
