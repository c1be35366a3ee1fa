#pragma once

#include <cstddef>

#include "sigmascape/atlas/store.h"

namespace sigmascape::atlas {

/// Makes what is missing or out of date of the levels above an atlas' patches, from the patches that are there: of σ0,
/// and where the ground is kept apart of its own σ0 and of the obstacles. Mends the catalogs. Returns how many textures
/// were written.
std::size_t make_levels_above(const Store& atlas, Scrutiny scrutiny = Scrutiny::Content);

}  // namespace sigmascape::atlas
