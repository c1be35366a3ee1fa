#pragma once

#include "physics/level_scene.h"

namespace sigmascape::simulate {

/// Houses in rows, close enough for several bounces.
inline scene::Scene street_scene() {
  using physics_test::lambert;
  scene::Scene scene = physics_test::level_scene(lambert("ground", 0.5), 256.0);
  scene.prototypes.push_back(scene::box_mesh({8.0F, 6.0F, 7.0F}, scene.material_index(lambert("box", 0.8))));
  for (int row = -3; row <= 3; ++row) {
    for (int column = -3; column <= 3; ++column) {
      scene.instances.push_back({.x_m = 12.0F * static_cast<float>(column), .y_m = 10.0F * static_cast<float>(row)});
    }
  }
  return scene;
}

}  // namespace sigmascape::simulate
