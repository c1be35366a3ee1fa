#include "sigmascape/scene/facet_area.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <span>
#include <tuple>
#include <unordered_map>
#include <vector>

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
  std::uint64_t edge;
  std::uint32_t triangle;
  bool goes_up;                ///< along it, by the words of its ends
  bool has_neighbour = false;  ///< that is wound alike

  friend bool operator<(const AtEdge& a, const AtEdge& b) {
    return std::tie(a.edge, a.triangle) < std::tie(b.edge, b.triangle);
  }
};

/// Whether twice the areas of two triangles are so of faces that are bent by less than 20°, whichever way these are
/// wound.
bool bends_gently(Vec3f a, Vec3f b) {
  constexpr float gentle2 = 0.88302F;  // cos² of 20°
  const float product = dot(a, b);
  return product * product > gentle2 * (dot(a, a) * dot(b, b));
}

/// Joins what hangs together at one edge. Seen from one side, neighbours that are wound alike go along it in opposite
/// ways, and those that are not the same way: these are joined where there is no other, for the front of a sheet and
/// its back, cut otherwise, are so as well. What goes the other way lies upon one another.
void join_across(std::span<AtEdge> at_edge, const std::vector<Vec3f>& doubled, DisjointGroups& faces) {
  const auto for_pairs = [&](bool wound_alike, const auto& visit) {
    for (std::size_t i = 0; i < at_edge.size(); ++i) {
      for (std::size_t j = i + 1; j < at_edge.size(); ++j) {
        AtEdge &here = at_edge[i], &there = at_edge[j];
        const Vec3f a = doubled[here.triangle], b = doubled[there.triangle];
        const bool are_alike = dot(a, b) > 0.0F, go_the_same_way = here.goes_up == there.goes_up;
        if (are_alike == wound_alike && go_the_same_way != wound_alike && bends_gently(a, b)) visit(here, there);
      }
    }
  };
  for_pairs(true, [&](AtEdge& here, AtEdge& there) {
    faces.join(here.triangle, there.triangle);
    here.has_neighbour = there.has_neighbour = true;
  });
  for_pairs(false, [&](AtEdge& here, AtEdge& there) {
    if (!here.has_neighbour && !there.has_neighbour) faces.join(here.triangle, there.triangle);
  });
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
  std::vector<AtEdge> sides;
  first_between.reserve(count);
  sides.reserve(std::size_t{3} * count);
  for (std::uint32_t t = 0; t < count; ++t) {
    std::array<std::uint64_t, 3> corner{};
    for (std::size_t i = 0; i < 3; ++i) corner[i] = place_of(vertices[mesh.triangles[t][i]]);
    if (const auto [first, is_first] = first_between.emplace(between(corner), t); !is_first) {
      faces.join(t, first->second);
      doubled[t] = {};
      continue;
    }
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint64_t from = corner[i], to = corner[(i + 1) % 3];
      sides.push_back({edge_between(from, to), t, from < to});
    }
  }
  std::ranges::sort(sides, std::less<>());
  for (auto first = sides.begin(); first != sides.end();) {
    const auto end = std::find_if(first, sides.end(), [&](const AtEdge& side) { return side.edge != first->edge; });
    join_across({first, end}, doubled, faces);
    first = end;
  }
  std::vector<float> face_area(count, 0.0F);
  for (std::uint32_t t = 0; t < count; ++t) face_area[faces.first_of(t)] += 0.5F * length(doubled[t]);
  std::vector<float> areas(count);
  for (std::uint32_t t = 0; t < count; ++t) areas[t] = face_area[faces.first_of(t)];
  return areas;
}

}  // namespace sigmascape::scene
