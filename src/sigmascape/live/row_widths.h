#pragma once

#include <cstddef>

#include "sigmascape/live/lattice_row.h"

namespace sigmascape::live {

/// Beams over which a texel is spread at most: those of a step of a scan then look so far to either side. What is wider
/// is as near as some tens of texels.
inline constexpr float most_beams_wide = 32.0F;

/// How wide a square is from so far away, along its sides, in radians: a quarter turn at most, as from above.
[[nodiscard]] double width_from(double distance_m, double side_m);

/// How many beams away a scatterer may stand that has a share in a beam, of ground that begins there.
[[nodiscard]] std::size_t beams_beside(double nearest_m, double cell_m, double beams_per_rad);

/// Fills beams_wide and middle_beam of a row that was located and may have texels that are wider than a beam. A
/// scatterer answers in a beam's width about its own place; the wider its texel, the more of all beams that lie over
/// the texel, about its middle, so that texels side by side leave no beam between them without power.
void find_widths(LatticeRow& row, const RowGeometry& geometry);

}  // namespace sigmascape::live
