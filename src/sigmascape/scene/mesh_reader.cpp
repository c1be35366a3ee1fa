#include "sigmascape/scene/mesh_reader.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <system_error>

#include "sigmascape/base/file_ending.h"
#include "sigmascape/base/units.h"
#include "sigmascape/scene/vector_section.h"

namespace sigmascape::scene {
namespace {

bool is_gltf(const std::filesystem::path& file) {
  const std::string ending = file_ending(file);
  return ending == ".gltf" || ending == ".glb";
}

ImportedMesh read_file(const std::filesystem::path& file) {
  std::error_code ignored;
  if (std::filesystem::is_directory(file, ignored))
    throw Error(file.string(), "is a folder", "name a file of glTF or OBJ");
  if (is_gltf(file)) return read_gltf(file);
  if (file_ending(file) == ".obj") return read_obj(file);
  throw Error(file.string(), "is neither glTF nor OBJ", "convert it to .gltf, .glb or .obj");
}

/// The scene's material for one of the file's names: the section's own table, the section's material, or a known
/// material of that name, with or without "itu_" before it.
const scatter::Material& counterpart(const std::string& name, const MeshSource& source,
                                     const MaterialTable& materials) {
  if (const auto listed = source.material_by_name.find(name); listed != source.material_by_name.end())
    return listed->second;
  for (const std::string& known : {name, name.starts_with("itu_") ? name.substr(4) : name})
    if (materials.knows(known)) return materials.material(known, source.where);
  if (source.material) return *source.material;
  throw Error(
      source.where, fmt::format("the material '{}' of {} has no counterpart", name, source.file.string()),
      fmt::format("name one under materials, such as \"{}\" = \"concrete\", or give material for all others", name));
}

bool is_degenerate(const Mesh& mesh, const std::array<std::uint32_t, 3>& triangle) {
  const Vec3d a = mesh.vertices[triangle[0]].to<double>(), b = mesh.vertices[triangle[1]].to<double>(),
              c = mesh.vertices[triangle[2]].to<double>();
  const Vec3d normal = cross(b - a, c - a);
  return !(dot(normal, normal) > 0.0);
}

void refuse_names_not_in_file(const MeshSource& source, const ImportedMesh& imported) {
  for (const auto& [name, material] : source.material_by_name) {
    if (std::ranges::find(imported.material_names, name) != imported.material_names.end()) continue;
    throw Error(source.where + ".materials", fmt::format("{} has no material '{}'", source.file.string(), name),
                fmt::format("use its names: {}", fmt::join(imported.material_names, ", ")));
  }
}

/// Throws Error when a vertex is not a number or lies farther from the mesh's origin than any object reaches.
void check_reach(const Mesh& mesh, const std::string& file) {
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    const double reach_m = length(mesh.vertices[i].to<double>());
    if (!std::isfinite(reach_m)) throw Error(file, fmt::format("vertex {} is not a number", i + 1), "export it again");
    if (reach_m <= longest_mesh_reach_m) continue;
    throw Error(file, fmt::format("vertex {} lies {:.6g} m from the mesh's origin", i + 1, reach_m),
                fmt::format("keep it within {:g} km: state scale, such as 0.001 for a file in millimetres, or move the "
                            "mesh to its own origin",
                            longest_mesh_reach_m / 1000.0));
  }
}

Mesh prototype_of(Scene& scene, const MeshSource& source, const MaterialTable& materials, FlawTally& tally) {
  const ImportedMesh imported = read_file(source.file);
  const std::string name = source.file.string();
  if (imported.triangles.empty()) throw Error(name, "has no faces", "give a mesh of triangles or polygons");
  refuse_names_not_in_file(source, imported);
  Mesh mesh;
  mesh.name = source.file.stem().string();
  mesh.is_solid = source.is_solid;
  mesh.vertices = vertices_in_scene_axes(imported, source.up, source.scale);
  check_reach(mesh, name);
  std::vector<MaterialIndex> index;
  for (const std::string& own : imported.material_names)
    index.push_back(scene.material_index(counterpart(own, source, materials)));
  for (std::size_t i = 0; i < imported.triangles.size(); ++i) {
    if (is_degenerate(mesh, imported.triangles[i])) {
      tally.flaw("faces without area, left out", fmt::format("face {}", i + 1));
      continue;
    }
    mesh.triangles.push_back(imported.triangles[i]);
    mesh.materials.push_back(index[imported.materials[i]]);
  }
  if (mesh.triangles.empty()) throw Error(name, "has no face with an area", "give a mesh of triangles or polygons");
  tally.settle(name, imported.triangles.size(), source.limit, scene.remarks);
  return mesh;
}

}  // namespace

MeshSource read_mesh_source(const TomlSection& section, const MaterialTable& materials, const FlawLimit& limit) {
  MeshSource source;
  source.where = section.where();
  source.file = section.file("file");
  source.up = section.choice_or("up", {"y", "z"}, is_gltf(source.file) ? "y" : "z") == "y" ? UpAxis::Y : UpAxis::Z;
  source.scale = section.number_or("scale", {1e-4, 1e4, ""}, 1.0);
  source.yaw_rad = radians_from_deg(section.number_or("yaw_deg", {-360.0, 360.0, "degrees"}, 0.0));
  source.lift_m = section.number_or("lift_m", {-1000.0, 10000.0, "m"}, 0.0);
  if (section.has("solid")) source.is_solid = section.flag_or("solid", false);
  source.speed_mps = section.number_or("speed_kmh", {0.0, 2000.0, "km/h"}, 0.0) / 3.6;
  if (section.has("material")) source.material = materials.named_by(section, "material", "");
  if (const auto names = section.section("materials")) {
    for (const std::string& name : names->keys()) {
      source.material_by_name[name] = materials.material(names->text(name), names->where(name));
    }
  }
  source.placements = read_placements(section);
  source.limit = read_flaw_limit(section, limit);
  section.refuse_unknown_keys();
  if (source.placements.empty()) {
    throw Error(section.where(), "does not say where the mesh stands",
                "give positions_m, positions_lat_lon_deg or positions");
  }
  return source;
}

std::vector<Vec3f> vertices_in_scene_axes(const ImportedMesh& mesh, UpAxis up, double scale) {
  std::vector<Vec3f> vertices;
  vertices.reserve(mesh.vertices.size());
  for (const Vec3d& v : mesh.vertices) {
    const Vec3d turned = up == UpAxis::Y ? Vec3d{-v.x, v.z, v.y} : v;
    vertices.push_back((turned * scale).to<float>());
  }
  return vertices;
}

void add_mesh(Scene& scene, const MeshSource& source, const MaterialTable& materials) {
  FlawTally of_faces, of_places;
  Mesh prototype = prototype_of(scene, source, materials, of_faces);
  const auto number = static_cast<std::uint32_t>(scene.prototypes.size());
  scene.prototypes.push_back(std::move(prototype));
  const FoundPlaces places = places_in(scene, source.placements);
  const std::string outside = "meshes outside the scene, left out";
  std::size_t inside = 0;
  for (const Vec2d& position : places.positions) {
    if (!scene.extent.contains(position)) {
      of_places.note(outside, fmt::format("({:.1f}, {:.1f}) m", position.x, position.y));
      continue;
    }
    ++inside;
    scene.instances.push_back({.prototype = number,
                               .x_m = static_cast<float>(position.x),
                               .y_m = static_cast<float>(position.y),
                               .lift_m = static_cast<float>(source.lift_m),
                               .yaw_rad = static_cast<float>(source.yaw_rad),
                               .speed_mps = static_cast<float>(source.speed_mps)});
  }
  if (inside == 0) of_places.leaves_nothing(outside);
  of_places.settle(source.file.string(), places.positions.size(), source.limit, scene.remarks);
  if (const auto& points = source.placements.points) {
    settle_census(places.of_file, *points, source.limit, scene.remarks);
  }
}

}  // namespace sigmascape::scene
