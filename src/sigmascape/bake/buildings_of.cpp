#include "sigmascape/bake/buildings_of.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "sigmascape/base/units.h"
#include "sigmascape/radar/face_reflectivity.h"
#include "sigmascape/radar/rectangle_parts.h"
#include "sigmascape/scatter/surface_sigma0.h"
#include "sigmascape/scene/buildings_within.h"
#include "sigmascape/trace/path_tracer.h"

namespace sigmascape::bake {
namespace {

/// A face that lies level, seen from so far above its horizon, is any face seen so far off its normal.
radar::FaceReflectivity reflectivity_of(const scatter::SurfaceModel& surface) {
  radar::FaceReflectivity reflectivity;
  for (std::size_t node = 0; node < radar::FaceReflectivity::node_count; ++node) {
    const double grazing_rad = 0.5 * pi - radar::FaceReflectivity::off_normal_rad(node);
    reflectivity.at_node.push_back(grazing_rad > 0.0 ? scatter::surface_sigma0(surface, grazing_rad)
                                                     : radar::Channels{});
  }
  return reflectivity;
}

/// Those that lie over into the scene's extent at most elevations: as far as the tallest does at 76°.
scene::Buildings near_by(const scene::Scene& scene) {
  const radar::Rectangle about = radar::widened(scene.extent, 4.0 * scene::tallest_object_m(scene));
  const std::vector<std::uint32_t> numbers = scene::buildings_within(scene.buildings, about);
  return numbers.size() == scene.buildings.items.size() ? scene.buildings : scene::part_of(scene.buildings, numbers);
}

std::vector<Vec3f> standing_vertices(const scene::Buildings& buildings) {
  std::vector<Vec3f> vertices = buildings.mesh.vertices;
  for (const scene::Building& building : buildings.items) {
    for (std::uint32_t i = 0; i < building.vertex_count; ++i)
      vertices[building.first_vertex + i].z += building.footing_m;
  }
  return vertices;
}

}  // namespace

atlas::Buildings buildings_of(const scene::Scene& scene, std::span<const double> frequencies_hz) {
  const scene::Buildings near = near_by(scene);
  const scene::Mesh& mesh = near.mesh;
  atlas::Buildings kept{
      .vertices = standing_vertices(near), .triangles = mesh.triangles, .material_of = {}, .materials = {}};
  const trace::SpectralSurfaces surfaces = trace::surface_models(scene, frequencies_hz);
  std::vector<std::optional<std::uint8_t>> number_of(scene.materials.size());
  for (const scene::MaterialIndex material : mesh.materials) {
    if (!number_of[material]) {
      number_of[material] = static_cast<std::uint8_t>(kept.materials.size());
      atlas::FaceMaterial& face = kept.materials.emplace_back();
      face.name = scene.materials[material].name;
      for (const auto& of_frequency : surfaces) face.reflectivity.push_back(reflectivity_of(of_frequency[material]));
    }
    kept.material_of.push_back(*number_of[material]);
  }
  return kept;
}

}  // namespace sigmascape::bake
