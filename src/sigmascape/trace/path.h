#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "sigmascape/base/sobol.h"
#include "sigmascape/base/vec.h"
#include "sigmascape/scatter/field.h"
#include "sigmascape/trace/ray.h"
#include "sigmascape/trace/scene_geometry.h"

namespace sigmascape::trace {

/// What a path carries at one frequency. All frequencies share the path, which was drawn from the densities of one of
/// them, its hero; docs/physics/estimator.md, Eq. (9).
struct Wave {
  scatter::FieldPair fields;  ///< divided by the square root of the hero's density
  /// Density with which this frequency as hero would have drawn the path, over the hero's.
  float forward = 1.0F;
  /// Density with which this frequency as hero would draw the reversed path, over the hero's density of the path;
  /// without the terms of the connection to the radar.
  float reverse = 1.0F;
};

/// One path on its way through the scene. The waves that it carries, one a frequency, are kept beside it.
struct Path {
  std::uint32_t start = 0;  ///< its number among those that are followed together
  SobolPoint point{0, 0};   ///< the numbers that it is drawn from
  std::size_t hero = 0;     ///< the frequency whose densities draw the directions
  bool is_alive = true;
  bool counts = true;         ///< whether it began where the launch area asks for
  Vec3d aim;                  ///< where on the launch plane it was aimed
  float launch_share = 1.0F;  ///< LaunchCell::share there
  Ray ray;                    ///< the one that it follows
  SurfaceHit hit;
  Vec3d first_position;  ///< of the first vertex, in the world
  double first_range_m = 0.0;
  double travelled_m = 0.0;  ///< between vertices
  /// How densely first vertices lie where it is, over the density of rays: the cosine at a surface, the extinction in a
  /// crown, times what the crowns before it let pass.
  float first_density = 1.0F;
  /// What crowns let pass of a direct echo on its way back.
  float direct_return = 1.0F;
  double imbalance = 0.0;  ///< of its books of power
};

}  // namespace sigmascape::trace
