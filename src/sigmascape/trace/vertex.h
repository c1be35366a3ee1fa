#pragma once

#include <algorithm>
#include <cmath>

#include "sigmascape/scatter/facet.h"
#include "sigmascape/trace/scene_geometry.h"

namespace sigmascape::trace {

/// What a vertex of a path is to waves, be it on a surface or within a crown.

/// Surfaces are left by this much along the normal, so that a ray does not meet again what it starts from: 2 mm, and
/// beyond 4 km from the origin, where single precision has steps of half a millimetre and more, four to eight of these.
[[nodiscard]] inline float surface_offset_m(Vec3f position) {
  return std::max({2e-3F, std::abs(position.x) * 0x1p-21F, std::abs(position.y) * 0x1p-21F});
}

/// The cosine between a direction and the normal; in a crown, which has none, one.
[[nodiscard]] inline float cosine_at(const SurfaceHit& hit, Vec3f direction) {
  return hit.is_in_crown() ? 1.0F : dot(direction, hit.normal);
}

/// How densely vertices lie along rays of that direction: cosine or extinction. docs/physics/vegetation.md, Eq. (6).
[[nodiscard]] inline float density_at(const SurfaceHit& hit, Vec3f direction) {
  return hit.is_in_crown() ? hit.extinction_per_m : dot(direction, hit.normal);
}

/// Whether what was hit stops a ray of that direction. Rounding lets rays meet faces that they run along: these have no
/// area for them, and a BRDF has no value there.
[[nodiscard]] inline bool stops(const SurfaceHit& hit, Vec3f direction) {
  return density_at(hit, -direction) > 0.0F;
}

/// Where rays that leave a vertex start.
[[nodiscard]] inline Vec3f start_from(const SurfaceHit& hit) {
  return hit.is_in_crown() ? hit.position : hit.position + hit.normal * surface_offset_m(hit.position);
}

[[nodiscard]] inline scatter::Facet face_of(const SurfaceHit& hit) {
  return {hit.normal, hit.inverse_facet_area_per_m2};
}

}  // namespace sigmascape::trace
