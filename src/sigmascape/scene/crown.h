#pragma once

#include "sigmascape/scene/scene.h"
#include "sigmascape/scene/tree_mesh.h"

namespace sigmascape::scene {

/// The ellipsoid that stands for the crown of a tree mesh of that form: the hull of a broadleaf, and for the cone of a
/// conifer the upright ellipsoid of its height and volume.
[[nodiscard]] Ellipsoid crown_ellipsoid(TreeForm form);

[[nodiscard]] double volume_m3(const Ellipsoid& ellipsoid);

/// One side of all triangles of a material, m².
[[nodiscard]] double surface_area_m2(const Mesh& mesh, MaterialIndex material);

/// The medium that intercepts and scatters as those leaves would if they were spread evenly over the crown and turned
/// every way: flat opaque leaves hide half their area, κ = LAD / 2, and the albedo is that of their material, which is
/// a facet surface or Lambert's. docs/physics/vegetation.md, Eq. (1). Throws Error for other materials.
[[nodiscard]] scatter::Material crown_material(const scatter::Material& leaf, double leaf_area_m2,
                                               double crown_volume_m3);

}  // namespace sigmascape::scene
