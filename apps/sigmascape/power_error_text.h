#pragma once

#include <string>

#include "sigmascape/atlas/power_error.h"

namespace sigmascape::cli {

/// "12.5 % of the power, 40 % of what returns with the bare ground, which has no noise", "none, for no texel returns
/// anything".
[[nodiscard]] std::string error_text(const atlas::PowerErrors& errors);

/// "28 % of the power in texels above the target"; empty where there is no target, or next to nothing was baked.
[[nodiscard]] std::string above_target_text(const atlas::PowerErrors& errors);

}  // namespace sigmascape::cli
