#include "sigmascape/trace/scene_heights.h"

#include <algorithm>

namespace sigmascape::trace {
namespace {

void take_in(SceneHeights& heights, const scene::Buildings& buildings, Footing footing) {
  const auto take_in_one = [&heights](float height_m) {
    heights.lowest_m = std::min(heights.lowest_m, static_cast<double>(height_m));
    heights.highest_m = std::max(heights.highest_m, static_cast<double>(height_m));
  };
  for (const scene::Building& building : buildings.items) {
    const float base_m = footing == Footing::Terrain ? building.footing_m : 0.0F;
    for (std::uint32_t i = 0; i < building.vertex_count; ++i)
      take_in_one(buildings.mesh.vertices[building.first_vertex + i].z + base_m);
  }
}

}  // namespace

SceneHeights heights_of(const scene::Scene& scene, Footing footing) {
  SceneHeights heights;
  const bool on_terrain = footing == Footing::Terrain;
  if (on_terrain) {
    const double highest_ground_m = scene.terrain.highest_m();
    heights = {scene.terrain.lowest_m(), highest_ground_m, highest_ground_m};
  }
  take_in(heights, scene.buildings, footing);
  const std::vector<float> tops_m = scene::prototype_tops_m(scene);
  for (const scene::Instance& instance : scene.instances) {
    const double base_m = on_terrain ? scene.terrain.height_at({instance.x_m, instance.y_m}) : 0.0;
    const float foot_m = static_cast<float>(base_m) + instance.lift_m;
    const float top_m = foot_m + tops_m[instance.prototype] * instance.scale.z;
    heights.highest_m = std::max(heights.highest_m, static_cast<double>(top_m));
  }
  return heights;
}

}  // namespace sigmascape::trace
