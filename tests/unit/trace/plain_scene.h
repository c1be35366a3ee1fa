#pragma once

#include <vector>

#include "sigmascape/base/units.h"
#include "sigmascape/scene/scene.h"
#include "sigmascape/scene/solid_mesh.h"

namespace sigmascape::trace {

inline constexpr double x_band_hz = 10e9;

inline scatter::Material lambert(std::string name, double albedo) {
  return {.name = std::move(name), .model = scatter::LambertParameters{albedo, {0.1, 0.5}}, .source = {}};
}

/// Ground of one material, 200 m square about (east, north), level at the given height.
inline scene::Scene plain_scene(double albedo = 0.5, float height_m = 0.0F, Vec2d centre = {}) {
  scene::Scene scene;
  scene.name = "plain";
  scene.extent = {centre.x - 100.0, centre.y - 100.0, centre.x + 100.0, centre.y + 100.0};
  scene.terrain = {scene.extent.west_m, scene.extent.north_m, 10.0, Array2D<float>(21, 21, height_m)};
  const scene::MaterialIndex ground = scene.material_index(lambert("ground", albedo));
  scene.ground = {{scene.extent.west_m, scene.extent.north_m, 200.0, 1, 1},
                  Array2D<scene::MaterialIndex>(1, 1, ground)};
  return scene;
}

/// Adds a box as an instance.
inline void add_box(scene::Scene& scene, Vec3f size_m, Vec2f place, double albedo = 0.5) {
  scene.prototypes.push_back(scene::box_mesh(size_m, scene.material_index(lambert("box", albedo))));
  scene.instances.push_back(
      {.prototype = static_cast<std::uint32_t>(scene.prototypes.size() - 1), .x_m = place.x, .y_m = place.y});
}

}  // namespace sigmascape::trace
