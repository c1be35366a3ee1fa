#include "sigmascape/scene/building_extrusion.h"

#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <utility>

#include "sigmascape/geo/polygon_triangulation.h"

namespace sigmascape::scene {
namespace {

/// Adds the walls over one ring; the area lies to the left of each edge, so the outward side is to the right.
void append_walls(Mesh& mesh, const geo::Ring& ring, float top_m, MaterialIndex material) {
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  const auto corners = static_cast<std::uint32_t>(ring.size());
  for (const Vec2d& corner : ring) {
    const auto x = static_cast<float>(corner.x), y = static_cast<float>(corner.y);
    mesh.vertices.push_back({x, y, 0.0F});
    mesh.vertices.push_back({x, y, top_m});
  }
  for (std::uint32_t i = 0; i < corners; ++i) {
    const std::uint32_t here = first + 2 * i, next = first + 2 * ((i + 1) % corners);
    mesh.triangles.push_back({here, next, next + 1});
    mesh.triangles.push_back({here, next + 1, here + 1});
    mesh.materials.insert(mesh.materials.end(), 2, material);
  }
}

}  // namespace

double footing_of(const geo::Polygon& outline, const terrain::HeightField& terrain) {
  const geo::Ring& ring = outline.outer;
  double lowest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Vec2d from = ring[i], edge = ring[(i + 1) % ring.size()] - from;
    const int steps = 1 + static_cast<int>(length(edge) / terrain.spacing_m);
    for (int step = 0; step < steps; ++step) {
      lowest = std::min(lowest, terrain.height_at(from + edge * (static_cast<double>(step) / steps)));
    }
  }
  return lowest;
}

void append_building(Buildings& buildings, const geo::Polygon& outline, double height_m, double footing_m,
                     MaterialIndex wall, MaterialIndex roof) {
  Mesh& mesh = buildings.mesh;
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  std::map<std::pair<double, double>, std::uint32_t> top_vertex;
  const auto raise = [&](const geo::Ring& ring) {
    const auto first_of_ring = static_cast<std::uint32_t>(mesh.vertices.size());
    for (std::uint32_t i = 0; i < ring.size(); ++i) top_vertex[{ring[i].x, ring[i].y}] = first_of_ring + 2 * i + 1;
    append_walls(mesh, ring, static_cast<float>(height_m), wall);
  };
  raise(outline.outer);
  for (const geo::Ring& hole : outline.holes) raise(hole);

  for (const auto& triangle : geo::triangulated(outline)) {
    std::array<std::uint32_t, 3> corners{};
    for (std::size_t i = 0; i < 3; ++i) corners[i] = top_vertex.at({triangle[i].x, triangle[i].y});
    mesh.triangles.push_back(corners);
    mesh.materials.push_back(roof);
  }
  buildings.items.push_back(
      {first, static_cast<std::uint32_t>(mesh.vertices.size()) - first, static_cast<float>(footing_m)});
}

}  // namespace sigmascape::scene
