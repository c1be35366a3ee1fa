#pragma once

#include "sigmascape/base/toml_reader.h"
#include "sigmascape/scatter/permittivity.h"

namespace sigmascape::scene {

/// Replaces the permittivity by what a material's section states, if it states any: `permittivity` and
/// `conductivity_s_per_m` (constant; of a power law the other part stays), `permittivity_law` = [a, b, c, d] of ITU-R
/// P.2040, or one of the tables `water`, `soil` and `plant`. Returns whether it did. Throws Error when more than one
/// way is taken.
bool read_permittivity(const TomlSection& section, scatter::Permittivity& permittivity);

}  // namespace sigmascape::scene
