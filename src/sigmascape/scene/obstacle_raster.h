#pragma once

#include "sigmascape/radar/obstacle.h"
#include "sigmascape/scene/scene.h"

namespace sigmascape::scene {

/// What of the scene stands on each cell of `grid`, its heights above the scene's own terrain.
///
/// Buildings are solid, and so are instances of meshes that are stated to be or, where nothing is stated, of which at
/// most half of the edges are open (belong to an odd number of triangles): a cell of which they cover half or more has
/// the height of their highest roof there. Instances of other meshes, such as trees with their leaves, are porous:
/// their surface over parts of a cell, at most 0.4 m wide on cells of up to 8 m, gives these an extinction of
///
///     κ = A / (2 · area · (top − base))
///
/// between the lowest and the highest of it, for surfaces of all orientations alike show half their area on the mean of
/// all directions (Cauchy); and the cell has the extinction by which as much passes as on lines through its parts
/// (radar/lines_across.h, docs/physics/vegetation.md). Cells beyond 2 m are merged from
/// four or sixteen smaller ones.
/// Throws Interrupted when this thread is told to stop (base/interruption.h): large scenes on fine cells take a minute.
/// Takes `obstacle_raster_bytes` of memory meanwhile.
[[nodiscard]] radar::ObstacleMap obstacles_of(const Scene& scene, const radar::GroundGrid& grid);

[[nodiscard]] double obstacle_raster_bytes(const radar::GroundGrid& grid);

/// The same over all of the scene, in cells from its north-western corner on.
[[nodiscard]] radar::ObstacleMap obstacles_of(const Scene& scene, double cell_m);

}  // namespace sigmascape::scene
