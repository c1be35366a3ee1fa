#include "sigmascape/scene/crown.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "sigmascape/base/error.h"
#include "sigmascape/base/sobol.h"
#include "sigmascape/base/units.h"

namespace sigmascape::scene {
namespace {

struct Triangle {
  Vec3f corner, along, across;
};

std::vector<Triangle> triangles_of(const Mesh& mesh, MaterialIndex material) {
  std::vector<Triangle> found;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    if (mesh.materials[i] != material) continue;
    const auto& [a, b, c] = mesh.triangles[i];
    found.push_back({mesh.vertices[a], mesh.vertices[b] - mesh.vertices[a], mesh.vertices[c] - mesh.vertices[a]});
  }
  return found;
}

/// Whether the line meets the triangle [Möller and Trumbore 1997].
bool meets(const Triangle& triangle, Vec3f point, Vec3f direction) {
  const Vec3f p = cross(direction, triangle.across);
  const float determinant = dot(triangle.along, p);
  if (determinant == 0.0F) return false;
  const Vec3f from_corner = point - triangle.corner;
  const float u = dot(from_corner, p) / determinant;
  if (u < 0.0F || u > 1.0F) return false;
  const float v = dot(direction, cross(from_corner, triangle.along)) / determinant;
  return v >= 0.0F && u + v <= 1.0F;
}

/// How long the line's way within the ellipsoid is.
double chord_m(const Ellipsoid& ellipsoid, Vec3f point, Vec3f direction) {
  const Vec3f r = ellipsoid.radii_m, o = point - ellipsoid.centre;
  const Vec3d from = Vec3f{o.x / r.x, o.y / r.y, o.z / r.z}.to<double>();
  const Vec3d step = Vec3f{direction.x / r.x, direction.y / r.y, direction.z / r.z}.to<double>();
  const double step2 = dot(step, step), along = dot(from, step);
  const double inside = along * along - step2 * (dot(from, from) - 1.0);
  return inside > 0.0 ? 2.0 * std::sqrt(inside) / step2 : 0.0;
}

double mean_passage(const std::vector<double>& chords_m, double extinction_per_m) {
  double sum = 0.0;
  for (const double chord : chords_m) sum += std::exp(-extinction_per_m * chord);
  return sum / static_cast<double>(chords_m.size());
}

}  // namespace

double volume_m3(const Ellipsoid& ellipsoid) {
  const Vec3d r = ellipsoid.radii_m.to<double>();
  return 4.0 / 3.0 * pi * r.x * r.y * r.z;
}

double surface_area_m2(const Mesh& mesh, MaterialIndex material) {
  double area = 0.0;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    if (mesh.materials[i] != material) continue;
    const auto& [a, b, c] = mesh.triangles[i];
    const Vec3f corner = mesh.vertices[a];
    area += 0.5 * static_cast<double>(length(cross(mesh.vertices[b] - corner, mesh.vertices[c] - corner)));
  }
  return area;
}

double even_extinction_per_m(double leaf_area_m2, double crown_volume_m3) {
  return 0.5 * leaf_area_m2 / crown_volume_m3;
}

double effective_extinction_per_m(const Mesh& mesh, MaterialIndex leaf, const Ellipsoid& crown) {
  constexpr std::uint32_t lines = 8192;
  const std::vector<Triangle> leaves = triangles_of(mesh, leaf);
  const float reach = std::max({crown.radii_m.x, crown.radii_m.y, crown.radii_m.z});
  std::vector<double> chords_m;
  double passed = 0.0;
  for (std::uint32_t line = 0; line < lines; ++line) {
    const Vec2f side = SobolPoint(0, line).pair(0), place = SobolPoint(0, line).pair(1);
    const float z = 1.0F - 2.0F * side.x, across = std::sqrt(1.0F - z * z);
    const float phi = static_cast<float>(2.0 * pi) * side.y;
    const Basis basis(Vec3f{across * std::cos(phi), across * std::sin(phi), z});
    const Vec3f point =
        crown.centre + basis.world_from_local({reach * (2.0F * place.x - 1.0F), reach * (2.0F * place.y - 1.0F), 0.0F});
    const double chord = chord_m(crown, point, basis.normal);
    if (chord <= 0.0) continue;
    chords_m.push_back(chord);
    const bool hidden = std::ranges::any_of(leaves, [&](const Triangle& t) { return meets(t, point, basis.normal); });
    passed += hidden ? 0.0 : 1.0;
  }
  passed /= static_cast<double>(chords_m.size());
  double low = 0.0, high = 100.0;
  for (int step = 0; step < 60; ++step) {
    const double middle = 0.5 * (low + high);
    (mean_passage(chords_m, middle) > passed ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

bool makes_crowns(const scatter::Material& leaf) {
  const auto* mirrors = std::get_if<scatter::CookTorranceParameters>(&leaf.model);
  if (mirrors != nullptr) return mirrors->scattering_coefficient == 0.0 && !mirrors->multiple_scatter;
  return std::holds_alternative<scatter::LambertParameters>(leaf.model);
}

scatter::Material crown_material(const scatter::Material& leaf, double extinction_per_m) {
  if (!makes_crowns(leaf)) {
    throw Error("leaf material " + leaf.name, "is of no leaves that crowns can be made of", leaves_of_crowns);
  }
  scatter::CrownParameters crown;
  crown.extinction_per_m = extinction_per_m;
  if (const auto* mirrors = std::get_if<scatter::CookTorranceParameters>(&leaf.model)) {
    crown.leaf = mirrors->permittivity;
  } else {
    const auto& lambert = std::get<scatter::LambertParameters>(leaf.model);
    crown.albedo = lambert.albedo;
    crown.depolarization = lambert.depolarization;
  }
  return {.name = "crown of " + leaf.name,
          .model = crown,
          .source = leaf.source,
          .verified = leaf.verified,
          .lowest_frequency_hz = leaf.lowest_frequency_hz,
          .highest_frequency_hz = leaf.highest_frequency_hz};
}

}  // namespace sigmascape::scene
