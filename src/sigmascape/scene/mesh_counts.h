#pragma once

#include <cstddef>

#include "sigmascape/scene/scene.h"

namespace sigmascape::scene {

/// How large the meshes of a scene are, its terrain among them. Unique: each prototype once, as they are stored.
/// Instanced: once for each instance, as they are seen.
struct MeshCounts {
  std::size_t unique_vertices = 0, unique_triangles = 0;
  std::size_t instanced_vertices = 0, instanced_triangles = 0;
};

[[nodiscard]] MeshCounts mesh_counts(const Scene& scene);

/// Triangles as they are seen, over the area of the scene's extent: of a scene that holds more than its extent too
/// many.
[[nodiscard]] double triangles_per_m2(const Scene& scene);

}  // namespace sigmascape::scene
