#pragma once

#include <vector>

#include "sigmascape/scene/scene.h"

namespace sigmascape::scene {

/// For every triangle of a mesh the area, in m², of the flat face it is part of: all triangles that lie in one plane
/// and hang together by shared edges. Edges are shared where their ends coincide within a millimetre, whether or not
/// the vertices are the same.
///
/// Diffraction widens what a flat face reflects by its size; how a modeller cut it into triangles must not matter.
[[nodiscard]] std::vector<float> facet_areas_m2(const Mesh& mesh);
/// The same of a mesh whose vertices stand in these places: of buildings on their footings.
[[nodiscard]] std::vector<float> facet_areas_m2(const Mesh& mesh, const std::vector<Vec3f>& vertices);

}  // namespace sigmascape::scene
