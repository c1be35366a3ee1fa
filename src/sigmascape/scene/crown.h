#pragma once

#include "sigmascape/scene/scene.h"
#include "sigmascape/scene/tree_mesh.h"

namespace sigmascape::scene {

/// The ellipsoid that stands for the crown of a tree mesh of that form: the hull of a broadleaf, and for the cone of a
/// conifer, whose leaves crowd at its foot, the upright one in which even leaves would have the same mean place and
/// spread.
[[nodiscard]] Ellipsoid crown_ellipsoid(TreeForm form);

[[nodiscard]] double volume_m3(const Ellipsoid& ellipsoid);

/// One side of all triangles of a material, m².
[[nodiscard]] double surface_area_m2(const Mesh& mesh, MaterialIndex material);

/// κ of flat opaque leaves that are spread evenly and turned every way: half their area density.
/// docs/physics/vegetation.md, Eq. (1).
[[nodiscard]] double even_extinction_per_m(double leaf_area_m2, double crown_volume_m3);

/// κ with which the ellipsoid lets as much pass, in the mean over rays from all sides, as do the triangles of the leaf
/// material: less than the even one where leaves crowd. docs/physics/vegetation.md, Eq. (9).
[[nodiscard]] double effective_extinction_per_m(const Mesh& mesh, MaterialIndex leaf, const Ellipsoid& crown);

/// Whether crowns can be made of leaves of that material: of mirrors or of Lambert's, and of no mixture of the two.
[[nodiscard]] bool makes_crowns(const scatter::Material& leaf);
/// What to do where they cannot.
inline constexpr const char* leaves_of_crowns =
    "use a material of model lambert, or of cook_torrance without scattering_coefficient and multi_scatter, or name a "
    "crown_material";

/// The medium of that extinction which scatters as leaves of a material do. Throws Error for those that make none.
[[nodiscard]] scatter::Material crown_material(const scatter::Material& leaf, double extinction_per_m);

}  // namespace sigmascape::scene
