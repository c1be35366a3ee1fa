#pragma once

#include <filesystem>

#include "sigmascape/scene/scene.h"

namespace sigmascape::scene {

/// Reads the landscape that a TOML file describes; docs/scene_file.md is the reference of its keys.
///
/// All of the TOML is checked before any data are read. Flawed features are mended or left out and told in the scene's
/// remarks. Throws Error, naming file and key or feature, for anything missing, unknown or out of range, and for data
/// too flawed to go on with.
[[nodiscard]] Scene read_scene(const std::filesystem::path& toml);

}  // namespace sigmascape::scene
