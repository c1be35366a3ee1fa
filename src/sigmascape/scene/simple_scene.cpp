#include "sigmascape/scene/simple_scene.h"

#include <fmt/format.h>

#include "sigmascape/base/error.h"
#include "sigmascape/scene/solid_mesh.h"

namespace sigmascape::scene {
namespace {

constexpr unsigned cylinder_sides = 96;

Instance placed(std::uint32_t prototype, Vec2d centre, double yaw_rad) {
  return {.prototype = prototype,
          .x_m = static_cast<float>(centre.x),
          .y_m = static_cast<float>(centre.y),
          .yaw_rad = static_cast<float>(yaw_rad)};
}

}  // namespace

Scene simple_scene(const SimpleSceneOptions& options) {
  if (!(options.side_m >= 1.0 && options.side_m <= 1e5))
    throw Error("simple scene", fmt::format("a side of {:g} m", options.side_m), "give 1 to 100000 m");
  const double half = options.side_m / 2.0;
  Scene scene;
  scene.name = "simple scene";
  scene.extent = {-half, -half, half, half};
  scene.terrain = {
      .west_m = -half, .north_m = half, .spacing_m = options.side_m, .height_m = Array2D<float>(2, 2, 0.0F)};
  const MaterialIndex ground = scene.material_index(scatter::library_material(options.ground_material));
  const MaterialIndex object = scene.material_index(scatter::library_material(options.object_material));
  scene.ground.grid = {.west_m = -half, .north_m = half, .cell_m = options.side_m, .columns = 1, .rows = 1};
  scene.ground.material = Array2D<MaterialIndex>(1, 1, ground);
  scene.prototypes.push_back(box_mesh(options.box_size_m, object));
  scene.prototypes.push_back(cylinder_mesh(static_cast<float>(options.cylinder_radius_m),
                                           static_cast<float>(options.cylinder_height_m), cylinder_sides, object));
  scene.instances.push_back(placed(0, options.box_centre, options.box_yaw_rad));
  scene.instances.push_back(placed(1, options.cylinder_centre, 0.0));
  return scene;
}

}  // namespace sigmascape::scene
