#pragma once

#include <cstddef>

#include "sigmascape/radar/ground_grid.h"
#include "sigmascape/scene/scene.h"
#include "sigmascape/terrain/height_field.h"

namespace sigmascape::trace {

/// The nodes of a field that its surface over a rectangle hangs on; the nearest where they have nothing in common. All
/// of the field when the rectangle holds it.
[[nodiscard]] terrain::HeightField ground_within(const terrain::HeightField& field, const radar::Rectangle& part);

/// How many nodes those are.
[[nodiscard]] std::size_t heights_within(const terrain::HeightField& field, const radar::Rectangle& part);

/// The cells of a map that a rectangle touches; the nearest where they have nothing in common.
[[nodiscard]] scene::MaterialMap ground_within(const scene::MaterialMap& map, const radar::Rectangle& part);

}  // namespace sigmascape::trace
