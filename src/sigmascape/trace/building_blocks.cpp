#include "sigmascape/trace/building_blocks.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace sigmascape::trace {
namespace {

/// Rays hardly tell blocks of 32 m from those of 64 m, of which a city has a quarter as many at some 6 kB each.
constexpr float block_side_m = 64.0F;

using Square = std::pair<std::int32_t, std::int32_t>;

Square square_of(Vec3f place) {
  const auto number = [](float metres) { return static_cast<std::int32_t>(std::floor(metres / block_side_m)); };
  return {number(place.x), number(place.y)};
}

Vec3f corner_of(const Square& square) {
  return {static_cast<float>(square.first) * block_side_m, static_cast<float>(square.second) * block_side_m, 0.0F};
}

/// Of each vertex the square of its building, lest that be torn apart; its own where it belongs to none.
std::vector<Square> squares_of(const scene::Buildings& buildings, const std::vector<Vec3f>& vertices) {
  std::vector<Square> squares;
  squares.reserve(vertices.size());
  for (const Vec3f& vertex : vertices) squares.push_back(square_of(vertex));
  for (const scene::Building& building : buildings.items) {
    const auto first = squares.begin() + building.first_vertex;
    if (building.vertex_count > 0) std::fill(first, first + building.vertex_count, *first);
  }
  return squares;
}

/// Numbers of quads by the squares of their first corners.
std::map<Square, std::vector<std::uint32_t>> by_squares(const FaceQuads& quads, const std::vector<Square>& squares) {
  std::map<Square, std::vector<std::uint32_t>> sorted;
  for (std::size_t i = 0; i < quads.corners.size(); ++i)
    sorted[squares[quads.corners[i][0]]].push_back(static_cast<std::uint32_t>(i));
  return sorted;
}

}  // namespace

BuildingBlocks building_blocks(const scene::Buildings& buildings, const std::vector<Vec3f>& vertices) {
  const FaceQuads all = face_quads(buildings.mesh, vertices);
  BuildingBlocks result;
  std::vector<std::uint32_t> number_in_block(vertices.size());
  for (const auto& [square, quads] : by_squares(all, squares_of(buildings, vertices))) {
    BuildingBlock block{.place = corner_of(square), .vertices = {}, .corners = {}, .first_face = result.traits.size()};
    std::vector<std::uint32_t> used;
    for (const std::uint32_t quad : quads) {
      used.insert(used.end(), all.corners[quad].begin(), all.corners[quad].end());
      result.traits.push_back(all.traits[quad]);
      result.traits.back().is_building = true;
    }
    std::ranges::sort(used);
    used.erase(std::unique(used.begin(), used.end()), used.end());
    for (const std::uint32_t vertex : used) {
      number_in_block[vertex] = static_cast<std::uint32_t>(block.vertices.size());
      block.vertices.push_back(vertices[vertex] - block.place);
    }
    for (const std::uint32_t quad : quads) {
      auto& corners = block.corners.emplace_back(all.corners[quad]);
      for (std::uint32_t& corner : corners) corner = number_in_block[corner];
    }
    result.blocks.push_back(std::move(block));
  }
  return result;
}

}  // namespace sigmascape::trace
