#pragma once

#include "sigmascape/geo/polygon.h"
#include "sigmascape/scene/scene.h"
#include "sigmascape/terrain/height_field.h"

namespace sigmascape::scene {

/// Adds a building with upright walls and a flat roof: two vertices a corner, walls facing outward (into courtyards as
/// well), the roof upward. It stands on the lowest terrain along its outline.
void append_building(Buildings& buildings, const geo::Polygon& outline, double height_m, MaterialIndex wall,
                     MaterialIndex roof, const terrain::HeightField& terrain);

}  // namespace sigmascape::scene
