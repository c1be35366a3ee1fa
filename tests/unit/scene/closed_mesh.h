#pragma once

#include <array>
#include <map>
#include <tuple>

#include "sigmascape/scene/scene.h"

namespace sigmascape::scene {

/// Whether every edge is walked as often one way as the other: no holes, and all facets turned alike. Corners are
/// matched by place.
inline bool is_closed(const Mesh& mesh) {
  using Place = std::tuple<float, float, float>;
  std::map<std::pair<Place, Place>, int> surplus;
  const auto place_of = [&](std::uint32_t vertex) {
    const Vec3f& v = mesh.vertices[vertex];
    return Place{v.x, v.y, v.z};
  };
  for (const auto& triangle : mesh.triangles) {
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const Place from = place_of(triangle[corner]), to = place_of(triangle[(corner + 1) % 3]);
      if (from < to) {
        ++surplus[{from, to}];
      } else {
        --surplus[{to, from}];
      }
    }
  }
  for (const auto& [edge, count] : surplus) {
    if (count != 0) return false;
  }
  return !surplus.empty();
}

}  // namespace sigmascape::scene
