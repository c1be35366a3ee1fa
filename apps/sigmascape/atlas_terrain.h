#pragma once

#include <memory>
#include <string>

#include "command.h"
#include "output.h"

namespace sigmascape::cli {

/// `atlas terrain`: puts terrain of any size beside the atlas in that folder.
void add_terrain_command(Command added, const std::shared_ptr<std::string>& folder, Output& output);

}  // namespace sigmascape::cli
