#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "sigmascape/base/vec.h"
#include "sigmascape/radar/face_reflectivity.h"

namespace sigmascape::atlas {

/// What faces of one material return.
struct FaceMaterial {
  std::string name;
  std::vector<radar::FaceReflectivity> reflectivity;  ///< [frequency], of the axis of the atlas
};

/// The walls and roofs of the buildings of an atlas that keeps them apart: what its textures lack of these, their
/// direct echoes, follows from them. docs/decisions/0171-buildings-apart.md.
struct Buildings {
  std::vector<Vec3f> vertices;                          ///< where they stand, heights as the terrain's
  std::vector<std::array<std::uint32_t, 3>> triangles;  ///< counter-clockwise as seen from outside
  std::vector<std::uint8_t> material_of;                ///< one a triangle, index into `materials`
  std::vector<FaceMaterial> materials;

  [[nodiscard]] std::size_t memory_bytes() const {
    std::size_t bytes = vertices.size() * sizeof(Vec3f) + triangles.size() * (sizeof(triangles[0]) + 1);
    for (const FaceMaterial& material : materials)
      bytes += material.reflectivity.size() * radar::FaceReflectivity::node_count * sizeof(radar::Channels);
    return bytes;
  }
};

}  // namespace sigmascape::atlas
