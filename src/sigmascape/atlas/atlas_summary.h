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
  /// Textures in a store of their own, of patches and above them.
  struct Layer {
    Files textures;                   ///< none is known to be planned where the collection has a fault
    std::optional<StoreFault> fault;  ///< of the collection, which alone tells what looks there are
  };
  struct Buildings {
    std::optional<StoreFault> fault;  ///< of `buildings.glb`; its content is not looked at
    std::optional<Layer> textures;    ///< of what buildings return, where these are to have such
  };
  Files pyramid;                            ///< textures of looks above the patches
  std::optional<Files> obstacles;           ///< of patches and above them, where the ground is kept apart
  std::optional<Layer> ground;              ///< where it is kept apart
  std::optional<Buildings> buildings;       ///< where they are kept apart
  std::optional<StoreFault> terrain_fault;  ///< of `terrain.tif`; its content is not looked at, nor are tiles
  std::uint64_t bytes = 0;                  ///< of everything in the folder
  double bytes_per_look = 0.0;              ///< mean size of the textures of patches
  /// Of the finest texels of all looks done whose items tell: those of ground do not, nor do those of a former kind.
  PowerErrors errors;
  std::size_t looks_told = 0;  ///< of those done, the ones whose items tell
};

[[nodiscard]] AtlasSummary summary_of(const Store& store);

}  // namespace sigmascape::atlas
