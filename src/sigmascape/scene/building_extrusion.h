#pragma once

#include "sigmascape/geo/polygon.h"
#include "sigmascape/scene/scene.h"
#include "sigmascape/terrain/height_field.h"

namespace sigmascape::scene {

/// Adds a building with upright walls and a flat roof: two vertices a corner, walls facing outward (into courtyards as
/// well), the roof upward. `height_m` is above its footing.
void append_building(Buildings& buildings, const geo::Polygon& outline, double height_m, double footing_m,
                     MaterialIndex wall, MaterialIndex roof);

/// The lowest terrain along the outline of a building, on which it stands.
[[nodiscard]] double footing_of(const geo::Polygon& outline, const terrain::HeightField& terrain);

}  // namespace sigmascape::scene
