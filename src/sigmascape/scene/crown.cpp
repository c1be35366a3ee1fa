#include "sigmascape/scene/crown.h"

#include <cmath>

#include "sigmascape/base/error.h"
#include "sigmascape/base/units.h"

namespace sigmascape::scene {

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

scatter::Material crown_material(const scatter::Material& leaf, double leaf_area_m2, double crown_volume_m3) {
  scatter::CrownParameters crown;
  crown.extinction_per_m = 0.5 * leaf_area_m2 / crown_volume_m3;
  if (const auto* mirrors = std::get_if<scatter::CookTorranceParameters>(&leaf.model)) {
    crown.leaf = mirrors->permittivity;
  } else if (const auto* lambert = std::get_if<scatter::LambertParameters>(&leaf.model)) {
    crown.albedo = lambert->albedo;
    crown.depolarization = lambert->depolarization;
  } else {
    throw Error("leaf material " + leaf.name, "its albedo is not known, so that no crown can be made of it",
                "use a material of model cook_torrance or lambert, or name a crown_material");
  }
  return {.name = "crown of " + leaf.name,
          .model = crown,
          .source = leaf.source,
          .verified = leaf.verified,
          .lowest_frequency_hz = leaf.lowest_frequency_hz,
          .highest_frequency_hz = leaf.highest_frequency_hz};
}

}  // namespace sigmascape::scene
