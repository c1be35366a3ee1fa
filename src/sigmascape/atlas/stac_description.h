#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

#include "sigmascape/atlas/store.h"

namespace sigmascape::atlas {

/// What a collection holds of the description of its atlas, under "sigmascape:atlas": all but the name.
[[nodiscard]] nlohmann::ordered_json described(const AtlasDescription& description);

/// What a collection was made from. Throws Error, naming `file`, when it is not a collection of ours.
[[nodiscard]] AtlasDescription description_from(const std::string& text, const std::filesystem::path& file);

/// In what two descriptions differ, "texel_m is 1.0 there and 2.0 here, and …", if anything: who gave two settings
/// others than before wants to hear of both. The name and the version of the format may differ.
[[nodiscard]] std::optional<std::string> difference(const AtlasDescription& there, const AtlasDescription& here);

}  // namespace sigmascape::atlas
