#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "sigmascape/atlas/atlas_summary.h"
#include "sigmascape/atlas/store.h"

namespace sigmascape::cli {

/// What `atlas info` prints of an atlas: for machines,
[[nodiscard]] nlohmann::ordered_json json_of(const atlas::Store& store, const atlas::AtlasSummary& summary);
/// and for people.
[[nodiscard]] std::string text_of(const atlas::Store& store, const atlas::AtlasSummary& summary);

}  // namespace sigmascape::cli
