#include "sigmascape/simulate/windblown.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <vector>

#include "sigmascape/scene/obstacle_raster.h"

namespace sigmascape::simulate {
namespace {

/// Crowns are told no finer than this.
constexpr double crown_cell_m = 2.0;

}  // namespace

bool is_plant_cover(std::string_view material) {
  constexpr std::array plants{"grass",  "crops",      "shrubs", "forest", "farmland",
                              "wooded", "vegetation", "trees",  "rural"};
  if (material.find("forest_floor") != std::string_view::npos) return false;
  return std::ranges::any_of(plants,
                             [&](std::string_view plant) { return material.find(plant) != std::string_view::npos; });
}

Windblown windblown_of(const scene::Scene& scene, const radar::Rectangle& area) {
  const radar::GroundGrid grid{.west_m = area.west_m,
                               .north_m = area.north_m,
                               .cell_m = crown_cell_m,
                               .columns = static_cast<std::size_t>(std::ceil(area.width_m() / crown_cell_m)),
                               .rows = static_cast<std::size_t>(std::ceil(area.height_m() / crown_cell_m))};
  std::vector<bool> plants;
  for (const auto& material : scene.materials) plants.push_back(is_plant_cover(material.name));
  return [&scene, plants, crowns = std::make_shared<const radar::ObstacleMap>(scene::obstacles_of(scene, grid))](
             Vec2d point) { return crowns->at(point).crown_top_m > 0.0F || plants[scene.ground.at(point)]; };
}

}  // namespace sigmascape::simulate
