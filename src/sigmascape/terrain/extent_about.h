#pragma once

#include <optional>

#include "sigmascape/geo/lattice.h"
#include "sigmascape/geo/local_frame.h"
#include "sigmascape/geo/raster.h"
#include "sigmascape/radar/ground_grid.h"

namespace sigmascape::terrain {

/// Of a raster that goes round the globe, and so has no edge, terrain reaches so far about what is wanted: no radar
/// stands farther from what it sees.
inline constexpr double reach_of_globe_m = 1000e3;

/// The rectangle of a frame over which there can be terrain from a raster about ground that is wanted: it holds as much
/// as can be of that ground first, then of what lies within 300 km about it, as far as radars in the air see ground,
/// and is as large as can be for the rest. Parallels and meridians are bows in the frame, hundreds of kilometres high
/// in a raster of a continent, so that the largest rectangle of all may lie anywhere. Nothing when the raster does not
/// reach what is wanted.
[[nodiscard]] std::optional<geo::Extent> extent_about(const geo::Raster& raster, const geo::LocalFrame& frame,
                                                      const radar::Rectangle& wanted);

}  // namespace sigmascape::terrain
