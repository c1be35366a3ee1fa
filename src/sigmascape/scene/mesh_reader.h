#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>

#include "sigmascape/base/toml_reader.h"
#include "sigmascape/scene/flaw_tally.h"
#include "sigmascape/scene/imported_mesh.h"
#include "sigmascape/scene/material_reader.h"
#include "sigmascape/scene/placements.h"
#include "sigmascape/scene/scene.h"

namespace sigmascape::scene {

enum class UpAxis { Y, Z };

/// How far from its origin a mesh may reach, when it has been brought to metres: more than any object has, and less
/// than most that was meant in other units or placed by the coordinates of a map.
inline constexpr double longest_mesh_reach_m = 50e3;

/// A mesh file, what its surfaces are made of, and where copies of it stand.
struct MeshSource {
  std::filesystem::path file;
  std::string where;  ///< the section, as errors name it
  UpAxis up = UpAxis::Z;
  double scale = 1.0;
  std::map<std::string, scatter::Material> material_by_name;  ///< for the file's own names
  std::optional<scatter::Material> material;                  ///< for all others
  Placements placements;
  std::optional<bool> is_solid;  ///< see Mesh::is_solid
  double yaw_rad = 0.0;
  double lift_m = 0.0;
  double speed_mps = 0.0;
  FlawLimit limit;
};

/// Reads one [[meshes]].
[[nodiscard]] MeshSource read_mesh_source(const TomlSection& section, const MaterialTable& materials,
                                          const FlawLimit& limit);

/// Adds the mesh as a prototype and its placements as instances. Throws Error when the mesh has no faces, a vertex is
/// not a number or lies beyond `longest_mesh_reach_m`, or a material name of the file has no counterpart.
void add_mesh(Scene& scene, const MeshSource& source, const MaterialTable& materials);

/// The mesh in the scene's axes, x east, y forward, z up, and metres. Of a file with y up (glTF, whose models face +z),
/// its +z becomes forward.
[[nodiscard]] std::vector<Vec3f> vertices_in_scene_axes(const ImportedMesh& mesh, UpAxis up, double scale);

}  // namespace sigmascape::scene
