#pragma once

#include "sigmascape/radar/obstacle.h"
#include "sigmascape/scene/scene.h"

namespace sigmascape::scene {

/// What of the scene stands on each cell of `grid`, its heights above the scene's own terrain.
///
/// Buildings are solid, and so are instances of meshes that are stated to be or, where nothing is stated, of which at
/// most half of the edges are open (belong to an odd number of triangles): a cell of which they cover half or more has
/// the height of their highest roof there. Instances of other meshes, such as trees with their leaves, are porous:
/// their surface, spread evenly over the space between the lowest and the highest of it that stands over the cell,
/// gives an extinction of
///
///     κ = A / (2 · cell area · (top − base))
///
/// for surfaces of all orientations alike show half their area on the mean of all directions (Cauchy).
/// Throws Interrupted when this thread is told to stop (base/interruption.h): large scenes on fine cells take a minute.
/// Takes `obstacle_raster_bytes_a_cell` of memory meanwhile.
[[nodiscard]] radar::ObstacleMap obstacles_of(const Scene& scene, const radar::GroundGrid& grid);

inline constexpr double obstacle_raster_bytes_a_cell = 140.0;

/// The same over all of the scene, in cells from its north-western corner on.
[[nodiscard]] radar::ObstacleMap obstacles_of(const Scene& scene, double cell_m);

}  // namespace sigmascape::scene
