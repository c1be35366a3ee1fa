#pragma once

#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <optional>
#include <vector>

#include "sigmascape/atlas/store.h"
#include "sigmascape/terrain/pyramid_faults.h"

namespace sigmascape::cli {

/// As a list of files and of what is wrong with them.
[[nodiscard]] nlohmann::ordered_json json_of(const std::vector<atlas::StoreFault>& faults);

[[nodiscard]] std::vector<atlas::StoreFault> in_list(const std::optional<atlas::StoreFault>& fault);

/// What is wrong with the tiles of the terrain, by file of the atlas. `faults_in` tells it of their folder. The ground
/// of an atlas has none of its own.
[[nodiscard]] std::vector<atlas::StoreFault> tile_faults(
    const atlas::Store& atlas,
    const std::function<std::vector<terrain::PyramidFault>(const std::filesystem::path&)>& faults_in);

}  // namespace sigmascape::cli
