#pragma once

#include "sigmascape/base/vec.h"
#include "sigmascape/radar/ground_grid.h"
#include "sigmascape/radar/radar.h"
#include "sigmascape/terrain/height_field.h"

namespace sigmascape::simulate {

/// Side of the cells of which each holds a scatterer, and of the texels by which they are told how bright they are:
/// half of what is told apart at the finest, in range or across it. With coarser cells there would be bins in which
/// none lies (docs/physics/speckle.md). What is told apart across follows from where the radar stands: there the side
/// is the next smaller one of a ladder, half a range cell times 2^(−k/8), so that a radar a little farther on, or a
/// second antenna beside it, finds the same scatterers.
[[nodiscard]] double scatterer_spacing_m(const radar::Radar& radar, double across_resolution_m);

/// Half-power width across range at a place of what is made of all pulses of an interval, as `coherent_plan` has it
/// (docs/physics/doppler.md, Eq. (3)). Infinite where pulses tell nothing apart: on the course, or while the radar
/// stands still.
[[nodiscard]] double resolution_of_interval_m(const radar::Radar& radar, Vec3d place, double interval_s);

/// The spacing for pulses of an interval: for what they can be processed to in the middle of the area. Where the
/// radar's mode maps the area, they are of the same scatterers as its image, unless they are of so much longer an
/// interval that they are finer across range by a tenth; those of a strip are so always, for there the interval says
/// how long the strip is and not how fine.
[[nodiscard]] double pulse_scatterer_spacing_m(const radar::Radar& radar, const radar::Rectangle& area,
                                               const terrain::HeightField& terrain, double interval_s);

}  // namespace sigmascape::simulate
