#include "sigmascape/trace/face_quads.h"

#include <cstddef>
#include <optional>

#include "sigmascape/scene/facet_area.h"

namespace sigmascape::trace {
namespace {

using Triangle = std::array<std::uint32_t, 3>;
using Quad = std::array<std::uint32_t, 4>;

/// The quad of two triangles of which one goes along an edge that the other goes back.
std::optional<Quad> joined(const Triangle& a, const Triangle& b) {
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      const std::uint32_t from = a[i], to = a[(i + 1) % 3];
      if (b[j] == to && b[(j + 1) % 3] == from) return Quad{a[(i + 2) % 3], from, b[(j + 2) % 3], to};
    }
  }
  return std::nullopt;
}

}  // namespace

FaceQuads face_quads(const scene::Mesh& mesh) {
  return face_quads(mesh, mesh.vertices);
}

FaceQuads face_quads(const scene::Mesh& mesh, const std::vector<Vec3f>& vertices) {
  const std::vector<float> areas_m2 = scene::facet_areas_m2(mesh, vertices);
  FaceQuads quads;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const Triangle& triangle = mesh.triangles[t];
    quads.traits.push_back({areas_m2[t] > 0.0F ? 1.0F / areas_m2[t] : 0.0F, mesh.materials[t]});
    const std::size_t next = t + 1;
    if (next < mesh.triangles.size() && areas_m2[next] == areas_m2[t] && mesh.materials[next] == mesh.materials[t]) {
      if (const auto quad = joined(triangle, mesh.triangles[next])) {
        quads.corners.push_back(*quad);
        t = next;
        continue;
      }
    }
    quads.corners.push_back({triangle[0], triangle[1], triangle[2], triangle[2]});
  }
  return quads;
}

}  // namespace sigmascape::trace
