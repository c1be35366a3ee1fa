#pragma once

#include <vector>

#include "sigmascape/trace/launch.h"

namespace sigmascape::trace {

/// The tiles of the launch lattice, row by row, from which rays can lead to where paths begin that count; a few more
/// come with them.
[[nodiscard]] std::vector<LaunchTile> tiles_aimed_at(const LaunchArea& outline);

}  // namespace sigmascape::trace
