#pragma once

#include <cstddef>

#include "sigmascape/live/lattice_row.h"

namespace sigmascape::live {

/// A horizon map as a row reads it: slopes [azimuth][distance], azimuth 0 at the left edge of beam 0.
struct Horizon {
  const float* slopes = nullptr;
  const float* solid_slopes = nullptr;  ///< of the tops of solid obstacles; null where none stand apart
  const float* through = nullptr;       ///< what comes through crowns
  std::size_t azimuths = 0, distances = 0;
  std::size_t stride = 0;   ///< from one azimuth to the next
  float first_beam = 0.0F;  ///< of the row's sector
  float per_beam = 1.0F;    ///< azimuths
  float turn = 0.0F;        ///< azimuths after which they begin anew; 0 where they do not
  float near_m = 0.0F, per_step = 1.0F;
};

/// Fills `lit`: texels that do not lie below the steepest line of sight to nearer ground, which is interpolated between
/// azimuths. Returns how many there are.
std::size_t light(LatticeRow& row, const Horizon& horizon);

/// After `light`: fills `ground_lit` with what is seen of the ground behind obstacles, and sets `lit` to the part of
/// what answers from above it (by height, up to `top_m`) that rises above the terrain's horizon.
void light_apart(LatticeRow& row, const Horizon& horizon);

/// Last of all: a texel is lit when its ground or what stands on it is.
void join_lights(LatticeRow& row);

}  // namespace sigmascape::live
