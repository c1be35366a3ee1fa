#pragma once

#include <cstddef>
#include <vector>

#include "sigmascape/atlas/store.h"

namespace sigmascape::atlas {

/// What became of the levels above the patches.
struct LevelsAbove {
  /// Files that were written: textures of looks, obstacles, and textures of the ground apart and of buildings apart.
  struct Written {
    std::size_t looks = 0, obstacles = 0, ground = 0, buildings = 0;

    [[nodiscard]] std::size_t all() const { return looks + obstacles + ground + buildings; }
  };
  Written written = {};
  std::size_t left_out = 0;  ///< files that could not be made
  /// What is wrong with the files of patches that those would be made of. Files are relative to the atlas.
  std::vector<StoreFault> hindrances = {};
};

/// Makes what is missing or out of date of the levels above an atlas' patches, from the patches that are there: of σ0,
/// where the ground is kept apart of its own σ0 and of the obstacles, and of what buildings return where that has
/// textures of its own. Mends the catalogs.
LevelsAbove make_levels_above(const Store& atlas, Scrutiny scrutiny = Scrutiny::Content);

}  // namespace sigmascape::atlas
