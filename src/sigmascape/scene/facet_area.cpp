#include "sigmascape/scene/facet_area.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <unordered_map>

#include "sigmascape/base/hash.h"
#include "sigmascape/scene/disjoint_groups.h"

namespace sigmascape::scene {
namespace {

/// The place of a vertex in whole millimetres, as one word.
std::uint64_t place_of(Vec3f vertex) {
  const auto millimetres = [](float metres) {
    return static_cast<std::uint64_t>(std::llround(static_cast<double>(metres) * 1e3));
  };
  return hashed(millimetres(vertex.x), millimetres(vertex.y), millimetres(vertex.z));
}

std::uint64_t edge_between(std::uint64_t a, std::uint64_t b) {
  return a < b ? hashed(a, b) : hashed(b, a);
}

/// The same for triangles between three corners, either way round.
std::uint64_t between(std::array<std::uint64_t, 3> corners) {
  std::ranges::sort(corners);
  return hashed(corners[0], corners[1], corners[2]);
}

/// Twice the area times the unit normal.
Vec3f doubled_area(const std::vector<Vec3f>& vertices, const std::array<std::uint32_t, 3>& triangle) {
  const Vec3f a = vertices[triangle[0]];
  return cross(vertices[triangle[1]] - a, vertices[triangle[2]] - a);
}

/// A triangle at one of its edges.
struct AtEdge {
  std::uint32_t triangle;
  bool goes_up;  ///< along it, by the words of its ends
};

/// Whether a surface goes on across an edge, by twice the areas of its triangles: with a gentle bend at most, whichever
/// way these are wound. Seen from one side, neighbours go along their edge in opposite ways; those that do not lie upon
/// one another, as front and back of a sheet do that were cut otherwise.
bool goes_on(Vec3f a, Vec3f b, bool same_way) {
  constexpr float gentle2 = 0.88302F;  // cos² of 20°
  const float product = dot(a, b), lengths2 = dot(a, a) * dot(b, b);
  return (product > 0.0F) != same_way && product * product > gentle2 * lengths2;
}

}  // namespace

std::vector<float> facet_areas_m2(const Mesh& mesh) {
  return facet_areas_m2(mesh, mesh.vertices);
}

std::vector<float> facet_areas_m2(const Mesh& mesh, const std::vector<Vec3f>& vertices) {
  const auto count = static_cast<std::uint32_t>(mesh.triangles.size());
  std::vector<Vec3f> doubled(count);
  for (std::uint32_t t = 0; t < count; ++t) doubled[t] = doubled_area(vertices, mesh.triangles[t]);

  DisjointGroups faces(count);
  // Meshes that are to be seen from both sides hold each triangle twice: it is one face of one area.
  std::unordered_map<std::uint64_t, std::uint32_t> first_between;
  std::unordered_multimap<std::uint64_t, AtEdge> at_edge;
  first_between.reserve(count);
  at_edge.reserve(std::size_t{3} * count);
  for (std::uint32_t t = 0; t < count; ++t) {
    std::array<std::uint64_t, 3> corner{};
    for (std::size_t i = 0; i < 3; ++i) corner[i] = place_of(vertices[mesh.triangles[t][i]]);
    if (const auto [first, is_first] = first_between.emplace(between(corner), t); !is_first) {
      faces.join(t, first->second);
      doubled[t] = {};
      continue;
    }
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint64_t from = corner[i], to = corner[(i + 1) % 3], edge = edge_between(from, to);
      const AtEdge here{t, from < to};
      const auto [first, last] = at_edge.equal_range(edge);
      for (auto found = first; found != last; ++found) {
        const AtEdge& there = found->second;
        if (goes_on(doubled[t], doubled[there.triangle], here.goes_up == there.goes_up)) faces.join(t, there.triangle);
      }
      at_edge.emplace(edge, here);
    }
  }
  std::vector<float> face_area(count, 0.0F);
  for (std::uint32_t t = 0; t < count; ++t) face_area[faces.first_of(t)] += 0.5F * length(doubled[t]);
  std::vector<float> areas(count);
  for (std::uint32_t t = 0; t < count; ++t) areas[t] = face_area[faces.first_of(t)];
  return areas;
}

}  // namespace sigmascape::scene
