#pragma once

#include <string>

#include "sigmascape/atlas/patch_grid.h"
#include "sigmascape/radar/look.h"

namespace sigmascape::atlas {

/// "patch_+000_-001": column and row on the world lattice.
[[nodiscard]] std::string patch_name(PatchIndex patch);

/// "az045.0_el13.0_f10.000GHz".
[[nodiscard]] std::string look_name(const radar::Look& look);

}  // namespace sigmascape::atlas
