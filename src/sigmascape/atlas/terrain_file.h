#pragma once

#include <filesystem>
#include <optional>

#include "sigmascape/atlas/store.h"

namespace sigmascape::atlas {

/// The scene's heights in the folder of an atlas, as terrain::write_height_field writes them, and the item beside them
/// that vouches for them, `terrain.json`.

/// Writes the item of the heights that are there. Throws Error when they cannot be read or it cannot be written.
void vouch_for_terrain(const Store& atlas);

/// What is wrong with the heights or their item, if anything.
[[nodiscard]] std::optional<StoreFault> terrain_fault(const Store& atlas, Scrutiny scrutiny);

/// The file of heights. Throws Error when it is not there or not as its item says.
[[nodiscard]] std::filesystem::path vouched_terrain(const Store& atlas, Scrutiny scrutiny);

}  // namespace sigmascape::atlas
