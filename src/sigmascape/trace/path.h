#pragma once

#include <cstddef>
#include <cstdint>

#include "sigmascape/base/sobol.h"
#include "sigmascape/base/vec.h"
#include "sigmascape/scatter/field.h"

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

/// What stays the same of a path on its way through the scene.
struct Path {
  std::uint32_t start = 0;    ///< its number among those that are followed together
  float launch_share = 1.0F;  ///< LaunchCell::share where it was aimed
  double beam = 0.0;          ///< Viewpoint::beam_of its ray
  double first_range_m = 0.0;
  Vec3f first_vertex;  ///< relative to the geometry's origin
  /// How densely first vertices lie where it is, over the density of rays: the cosine at a surface, the extinction in a
  /// crown, times what the crowns before it let pass.
  float first_density = 1.0F;
  /// What crowns let pass of a direct echo on its way back.
  float direct_return = 1.0F;
  bool counts = true;      ///< whether it began where the launch area asks for
  double imbalance = 0.0;  ///< of its books of power
};

/// The way of a path from one vertex to the next. Its ray, what that meets and the waves that go along it, one a
/// frequency, are kept beside it.
struct Leg {
  std::uint32_t path = 0;    ///< whose it is
  std::uint32_t hero = 0;    ///< the frequency whose densities draw the directions
  SobolPoint point{0, 0};    ///< the numbers that the path is drawn from
  double travelled_m = 0.0;  ///< between vertices, before this leg
};

}  // namespace sigmascape::trace
