#include "results/vertices.h"

#include <algorithm>
#include <cmath>

namespace sigmascape::cli {
namespace {

/// Nodes `first_m`, first_m + spacing_m, … of so many that lie between two places.
std::size_t nodes_between(double from_m, double to_m, double first_m, double spacing_m, std::size_t count) {
  const double last = std::min(std::floor((to_m - first_m) / spacing_m), static_cast<double>(count) - 1.0);
  const double first = std::max(std::ceil((from_m - first_m) / spacing_m), 0.0);
  return last < first ? 0 : static_cast<std::size_t>(last - first) + 1;
}

}  // namespace

VertexCounts vertices_within_extent(const scene::Scene& scene) {
  const radar::Rectangle& extent = scene.extent;
  const terrain::HeightField& field = scene.terrain;
  VertexCounts counts;
  counts.terrain =
      nodes_between(extent.west_m, extent.east_m, field.west_m, field.spacing_m, field.height_m.columns()) *
      nodes_between(-extent.north_m, -extent.south_m, -field.north_m, field.spacing_m, field.height_m.rows());
  for (const Vec3f& vertex : scene.buildings.mesh.vertices) {
    if (extent.contains({vertex.x, vertex.y})) ++counts.objects;
  }
  for (const scene::Instance& instance : scene.instances) {
    if (extent.contains({instance.x_m, instance.y_m}))
      counts.objects += scene.prototypes[instance.prototype].vertices.size();
  }
  return counts;
}

}  // namespace sigmascape::cli
