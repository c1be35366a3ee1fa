#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "sigmascape/scene/scene.h"

namespace sigmascape::trace {

/// What is to be known of a face that a ray has met.
struct FaceTraits {
  float inverse_area_per_m2 = 0.0F;  ///< of the whole face, as scene::facet_areas_m2 finds it; 0 of one without
  scene::MaterialIndex material = 0;
  bool is_building = false;  ///< whether it belongs to one of Scene::buildings
};

/// A mesh in pieces of four corners.
///
/// A quad is the triangles (0, 1, 3) and (2, 3, 1) of its corners. Two triangles that follow one another in the mesh,
/// share an edge and belong to one face of one material make one quad, so that a leaf or a wall is one thing to be
/// asked about instead of two; a triangle that is left over repeats its last corner. Neither form nor sides change.
struct FaceQuads {
  std::vector<std::array<std::uint32_t, 4>> corners;  ///< numbers of vertices
  std::vector<FaceTraits> traits;                     ///< one a quad
};

/// Of the mesh as it stands, or with its vertices in other places.
[[nodiscard]] FaceQuads face_quads(const scene::Mesh& mesh);
[[nodiscard]] FaceQuads face_quads(const scene::Mesh& mesh, const std::vector<Vec3f>& vertices);

}  // namespace sigmascape::trace
