#include "sigmascape/scene/solid_mesh.h"

#include <cmath>
#include <vector>

#include "sigmascape/base/units.h"

namespace sigmascape::scene {
namespace {

Vec3f raised(Vec2f p, float z) {
  return {p.x, p.y, z};
}

}  // namespace

void append_facet(Mesh& mesh, std::span<const Vec3f> corners, MaterialIndex material) {
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  mesh.vertices.insert(mesh.vertices.end(), corners.begin(), corners.end());
  for (std::uint32_t corner = 2; corner < corners.size(); ++corner) {
    mesh.triangles.push_back({first, first + corner - 1, first + corner});
    mesh.materials.push_back(material);
  }
}

void append_prism(Mesh& mesh, std::span<const Vec2f> outline, float bottom_m, float top_m, MaterialIndex material) {
  std::vector<Vec3f> roof, floor;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Vec2f here = outline[i], next = outline[(i + 1) % outline.size()];
    const Vec3f side[] = {raised(here, bottom_m), raised(next, bottom_m), raised(next, top_m), raised(here, top_m)};
    append_facet(mesh, side, material);
    roof.push_back(raised(here, top_m));
    floor.push_back(raised(outline[(outline.size() - i) % outline.size()], bottom_m));
  }
  append_facet(mesh, roof, material);
  append_facet(mesh, floor, material);
}

Mesh box_mesh(Vec3f size_m, MaterialIndex material) {
  const float x = size_m.x / 2.0F, y = size_m.y / 2.0F;
  const Vec2f outline[] = {{-x, -y}, {x, -y}, {x, y}, {-x, y}};
  Mesh mesh{.name = "box", .vertices = {}, .triangles = {}, .materials = {}};
  append_prism(mesh, outline, 0.0F, size_m.z, material);
  return mesh;
}

Mesh cylinder_mesh(float radius_m, float height_m, unsigned sides, MaterialIndex material) {
  std::vector<Vec2f> outline;
  for (unsigned side = 0; side < sides; ++side) {
    const double angle = 2.0 * pi * side / sides;
    outline.push_back({radius_m * static_cast<float>(std::cos(angle)), radius_m * static_cast<float>(std::sin(angle))});
  }
  Mesh mesh{.name = "cylinder", .vertices = {}, .triangles = {}, .materials = {}};
  append_prism(mesh, outline, 0.0F, height_m, material);
  return mesh;
}

Mesh wall_mesh(float length_m, float height_m, MaterialIndex material) {
  const float x = length_m / 2.0F;
  const Vec3f corners[] = {{-x, 0.0F, 0.0F}, {x, 0.0F, 0.0F}, {x, 0.0F, height_m}, {-x, 0.0F, height_m}};
  Mesh mesh{.name = "wall", .vertices = {}, .triangles = {}, .materials = {}};
  append_facet(mesh, corners, material);
  return mesh;
}

double signed_volume_m3(const Mesh& mesh) {
  double sixfold = 0.0;
  for (const auto& [a, b, c] : mesh.triangles) {
    sixfold += dot(mesh.vertices[a].to<double>(), cross(mesh.vertices[b].to<double>(), mesh.vertices[c].to<double>()));
  }
  return sixfold / 6.0;
}

void append_mesh(Mesh& mesh, const Mesh& part, Vec3f offset) {
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  for (const Vec3f& vertex : part.vertices) mesh.vertices.push_back(vertex + offset);
  for (const auto& [a, b, c] : part.triangles) mesh.triangles.push_back({first + a, first + b, first + c});
  mesh.materials.insert(mesh.materials.end(), part.materials.begin(), part.materials.end());
}

}  // namespace sigmascape::scene
