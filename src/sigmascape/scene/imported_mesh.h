#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "sigmascape/base/vec.h"

namespace sigmascape::scene {

/// Triangles as a mesh file holds them: its own axes and units, materials as its own names.
struct ImportedMesh {
  std::vector<Vec3d> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::vector<std::string> material_names;  ///< the empty name stands for faces without one
  std::vector<std::size_t> materials;       ///< one a triangle, index into material_names

  /// Index of a material name, added when it is new.
  std::size_t material_index(const std::string& name);
};

/// Reads a Wavefront OBJ file; polygons are cut into triangles. Material names come from `usemtl` alone, so no MTL file
/// is needed. Throws Error when the file is damaged.
[[nodiscard]] ImportedMesh read_obj(const std::filesystem::path& file);

/// Reads all triangles of a glTF or GLB file's scene, its node transforms applied. Throws Error when the file is
/// damaged, or needs an extension, a sparse accessor or a vertex format that is not supported.
[[nodiscard]] ImportedMesh read_gltf(const std::filesystem::path& file);

}  // namespace sigmascape::scene
