#pragma once

#include "sigmascape/base/vec.h"
#include "sigmascape/trace/scene_geometry.h"

namespace sigmascape::simulate {

/// Rays leave a surface this far above it, lest they meet it.
constexpr double ray_lift_m = 0.02;

/// The ground as rays meet it, for whom squares of the terrain are pairs of triangles: it lies as far above or below
/// `place`, a point on the terrain or over it, as a square is twisted. The place itself where something else lies
/// between.
[[nodiscard]] Vec3d ground_met_at(const trace::SceneGeometry& geometry, Vec3d place);

}  // namespace sigmascape::simulate
