#pragma once

#include <string>

#include "sigmascape/scene/scene.h"

namespace sigmascape::scene {

/// The scene of the paper's Figure 1: a prism and a cylinder on a plane.
struct SimpleSceneOptions {
  double side_m = 128.0;  ///< of the square plane, centred on the origin
  Vec2d box_centre{-20.0, 0.0};
  Vec3f box_size_m{24.0F, 16.0F, 12.0F};
  double box_yaw_rad = 0.0;  ///< clockwise from north
  Vec2d cylinder_centre{24.0, 0.0};
  double cylinder_radius_m = 7.0;
  double cylinder_height_m = 14.0;
  std::string ground_material = "concrete";
  std::string object_material = "concrete";
};

/// Flat terrain at height 0 with the box and the cylinder as instances. Material names are those of the material
/// library; throws Error for one it does not know, and for a side that is not 1 m to 100 km.
[[nodiscard]] Scene simple_scene(const SimpleSceneOptions& options = {});

}  // namespace sigmascape::scene
