#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "sigmascape/atlas/store.h"

namespace sigmascape::atlas {

/// What stands in a folder that holds no collection under a name by which a bake of that atlas writes, and is not what
/// is left of one: "terrain.tif" beside a scene that is made from it. A bake there would write over it. Nothing when
/// there is none: then the folder is free, or holds an atlas whose collection was removed so that it is written anew.
[[nodiscard]] std::optional<std::string> file_of_others(const std::filesystem::path& folder,
                                                        const AtlasDescription& description);

}  // namespace sigmascape::atlas
