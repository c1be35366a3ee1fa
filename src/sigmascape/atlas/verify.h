#pragma once

#include <vector>

#include "sigmascape/atlas/store.h"

namespace sigmascape::atlas {

/// Everything that is missing of an atlas or not as recorded: catalogs, textures, the pyramid above them, the buildings
/// where they are kept apart, and where the ground is its textures and the obstacles of all levels. Files are relative
/// to the atlas. Tells `progress`, where there is one, of the textures of the patches, as Store::verify does.
[[nodiscard]] std::vector<StoreFault> verify(const Store& atlas, Scrutiny scrutiny = Scrutiny::Content,
                                             ProgressListener* progress = nullptr);

}  // namespace sigmascape::atlas
