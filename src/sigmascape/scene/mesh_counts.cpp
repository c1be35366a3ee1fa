#include "sigmascape/scene/mesh_counts.h"

namespace sigmascape::scene {

MeshCounts mesh_counts(const Scene& scene) {
  const auto& field = scene.terrain.height_m;
  const std::size_t terrain_triangles = 2 * (field.columns() - 1) * (field.rows() - 1);
  MeshCounts counts;
  counts.unique_vertices = counts.instanced_vertices = field.size() + scene.buildings.mesh.vertices.size();
  counts.unique_triangles = counts.instanced_triangles = terrain_triangles + scene.buildings.mesh.triangles.size();
  for (const Mesh& prototype : scene.prototypes) {
    counts.unique_vertices += prototype.vertices.size();
    counts.unique_triangles += prototype.triangles.size();
  }
  for (const Instance& instance : scene.instances) {
    counts.instanced_vertices += scene.prototypes[instance.prototype].vertices.size();
    counts.instanced_triangles += scene.prototypes[instance.prototype].triangles.size();
  }
  return counts;
}

double triangles_per_m2(const Scene& scene) {
  return static_cast<double>(mesh_counts(scene).instanced_triangles) /
         (scene.extent.width_m() * scene.extent.height_m());
}

}  // namespace sigmascape::scene
