#pragma once

#include <span>

#include "sigmascape/scene/scene.h"

namespace sigmascape::scene {

/// Adds a flat facet with vertices of its own. The corners go counter-clockwise seen from outside; all of the facet
/// must be visible from the first one.
void append_facet(Mesh& mesh, std::span<const Vec3f> corners, MaterialIndex material);

/// Adds a closed upright prism. The outline goes counter-clockwise seen from above; all of it must be visible from its
/// first corner.
void append_prism(Mesh& mesh, std::span<const Vec2f> outline, float bottom_m, float top_m, MaterialIndex material);

/// A closed box on the plane z = 0, centred on the origin, with outward normals.
[[nodiscard]] Mesh box_mesh(Vec3f size_m, MaterialIndex material);

/// A closed upright cylinder on the plane z = 0 about the z axis, of `sides` flat sides whose corners lie on the
/// radius, with outward normals.
[[nodiscard]] Mesh cylinder_mesh(float radius_m, float height_m, unsigned sides, MaterialIndex material);

/// An upright rectangle without thickness on the plane z = 0, centred on the origin, along x and facing −y.
[[nodiscard]] Mesh wall_mesh(float length_m, float height_m, MaterialIndex material);

/// Volume inside a closed mesh whose normals point outward; negative when they point inward.
[[nodiscard]] double signed_volume_m3(const Mesh& mesh);

/// Adds all of `part` to `mesh`, moved by `offset`.
void append_mesh(Mesh& mesh, const Mesh& part, Vec3f offset = {});

}  // namespace sigmascape::scene
