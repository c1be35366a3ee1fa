#pragma once

#include "sigmascape/atlas/aspect_grid.h"
#include "sigmascape/radar/radar.h"
#include "sigmascape/terrain/height_field.h"

namespace sigmascape::simulate {

/// The looks that a real-beam map of `area` is blended from: those about every direction in which the radar stands from
/// ground that answers in it, between the lowest and the highest terrain. An atlas of these alone gives the same map to
/// the bit. Assumes textures that are looked up upright (render::SlopeModel) over a flat Earth, as baked_image does by
/// default.
[[nodiscard]] atlas::AspectSelection looks_of_map(const atlas::AspectGrid& baked, const radar::Radar& radar,
                                                  const radar::Rectangle& area, const terrain::HeightField& terrain);

}  // namespace sigmascape::simulate
