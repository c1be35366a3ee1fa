#pragma once

#include "physics/baked_atlas.h"
#include "physics/level_scene.h"

namespace sigmascape::physics_test {

inline constexpr double seen_elevation_deg = 20.0;
inline constexpr double box_height_m = 12.0, half_box_m = 6.0;

/// Ground of constant gamma, 512 m square, that rises northward by `rise`, with a box in its middle.
inline scene::Scene ground_with_box(double rise, bool with_box) {
  scene::Scene scene = level_scene(gamma_ground(), 512.0);
  for (const std::size_t column : {0U, 1U}) {
    scene.terrain.height_m(column, 0) = static_cast<float>(256.0 * rise);
    scene.terrain.height_m(column, 1) = static_cast<float>(-256.0 * rise);
  }
  if (!with_box) return scene;
  const scatter::Material wall{.name = "wall", .model = scatter::LambertParameters{0.1, {0.1, 0.5}}, .source = {}};
  const auto side = static_cast<float>(2.0 * half_box_m);
  scene.prototypes.push_back(
      scene::box_mesh({side, side, static_cast<float>(box_height_m)}, scene.material_index(wall)));
  scene.instances.push_back({.x_m = 0.0F, .y_m = 0.0F});
  return scene;
}

/// The scene baked from the south at the one elevation, and loaded.
inline atlas::Atlas baked_from_south(const scene::Scene& scene, bake::Shadows shadows) {
  bake::BakeSettings settings;
  settings.aspects = {{pi}, {radians_from_deg(seen_elevation_deg)}, {frequency_hz}};
  settings.patches = {2.0, 256};
  settings.sampling.samples_per_texel = 8;
  settings.shadows = shadows;
  return baked_atlas(scene, settings);
}

}  // namespace sigmascape::physics_test
