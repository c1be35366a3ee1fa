#pragma once

#include <vector>

#include "sigmascape/scene/scene.h"

namespace sigmascape::scene {

/// For every triangle of a mesh the area, in m², of the face it is part of: all triangles that hang together by shared
/// edges across which the surface stays flat, or bends by less than 20° as those of curved bodies do. Edges are shared
/// where their ends coincide within a millimetre, whether or not the vertices are the same.
///
/// Diffraction widens what a face reflects by its size; how finely a modeller cut it into triangles must not matter.
/// docs/decisions/0176-curved-skins-are-one-face.md.
[[nodiscard]] std::vector<float> facet_areas_m2(const Mesh& mesh);
/// The same of a mesh whose vertices stand in these places: of buildings on their footings.
[[nodiscard]] std::vector<float> facet_areas_m2(const Mesh& mesh, const std::vector<Vec3f>& vertices);

}  // namespace sigmascape::scene
