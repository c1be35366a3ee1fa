#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "sigmascape/trace/face_quads.h"

namespace sigmascape::trace {

/// The walls and roofs of the buildings of one square, to be instanced as a whole.
struct BuildingBlock {
  Vec3f place;  ///< that its vertices are relative to
  std::vector<Vec3f> vertices;
  std::vector<std::array<std::uint32_t, 4>> corners;  ///< numbers of its own vertices, four a quad
  std::size_t first_face = 0;                         ///< of its quads, in that order, among BuildingBlocks::traits
};

/// Buildings by squares, so that they can stand among trees and vehicles in one hierarchy of instances: one mesh of all
/// would be a hierarchy of its own, and every ray would have to go through both.
struct BuildingBlocks {
  std::vector<FaceTraits> traits;
  std::vector<BuildingBlock> blocks;
};

/// `vertices` takes the place of that of the buildings' mesh: the vertices where they stand.
[[nodiscard]] BuildingBlocks building_blocks(const scene::Buildings& buildings, const std::vector<Vec3f>& vertices);

}  // namespace sigmascape::trace
