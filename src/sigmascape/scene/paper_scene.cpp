#include "sigmascape/scene/paper_scene.h"

#include <cmath>
#include <fmt/format.h>

#include "sigmascape/base/error.h"
#include "sigmascape/base/hash.h"
#include "sigmascape/base/interruption.h"
#include "sigmascape/scene/paper_landscape.h"
#include "sigmascape/scene/paper_layout.h"
#include "sigmascape/scene/paper_town.h"
#include "sigmascape/scene/paper_traffic.h"
#include "sigmascape/scene/paper_trees.h"
#include "sigmascape/scene/tree_mesh.h"
#include "sigmascape/scene/vehicle_mesh.h"

namespace sigmascape::scene {
namespace {

constexpr double smallest_scale = 0.1, largest_scale = 5.0;
constexpr std::uint32_t broadleaf_prototypes = 4, conifer_prototypes = 2;

std::size_t nearest_power_of_two(double count) {
  return std::size_t{1} << static_cast<unsigned>(std::lround(std::log2(count)));
}

/// The names of the library materials of one preset.
struct MaterialNames {
  const char *concrete, *asphalt;
  const char *house_walls, *house_roof, *block_walls, *block_roof, *hall_walls, *hall_roof;
  const char *bark, *leaf;
};

constexpr MaterialNames paper_names{.concrete = "concrete",
                                    .asphalt = "concrete",
                                    .house_walls = "paper_building",
                                    .house_roof = "paper_building",
                                    .block_walls = "paper_building",
                                    .block_roof = "paper_building",
                                    .hall_walls = "paper_building",
                                    .hall_roof = "paper_building",
                                    .bark = "paper_bark",
                                    .leaf = "paper_leaf"};
constexpr MaterialNames itu_names{.concrete = "concrete",
                                  .asphalt = "asphalt",
                                  .house_walls = "brick",
                                  .house_roof = "brick",
                                  .block_walls = "concrete",
                                  .block_roof = "concrete",
                                  .hall_walls = "concrete",
                                  .hall_roof = "metal",
                                  .bark = "bark",
                                  .leaf = "leaf"};

/// The materials of a preset, put into the scene when they are first asked for.
class PaperPalette {
 public:
  PaperPalette(Scene& scene, PaperMaterials preset)
      : scene_(scene), names_(preset == PaperMaterials::Paper ? paper_names : itu_names) {}

  [[nodiscard]] MaterialIndex index(const char* name) const {
    return scene_.material_index(scatter::library_material(name));
  }

  [[nodiscard]] MaterialIndex of(GroundClass ground) const {
    switch (ground) {
      case GroundClass::Concrete:
        return index(names_.concrete);
      case GroundClass::Asphalt:
        return index(names_.asphalt);
      case GroundClass::Grass:
        return index("grass");
      case GroundClass::Water:
        return index("water");
      case GroundClass::Dirt:
        return index("bare_soil");
      case GroundClass::ForestFloor:
        break;
    }
    return index("forest_floor");
  }
  [[nodiscard]] TownMaterials town() const {
    return {.house = {index(names_.house_walls), index(names_.house_roof)},
            .block = {index(names_.block_walls), index(names_.block_roof)},
            .hall = {index(names_.hall_walls), index(names_.hall_roof)}};
  }
  [[nodiscard]] TreeMaterials tree() const { return {.bark = index(names_.bark), .leaf = index(names_.leaf)}; }

 private:
  Scene& scene_;
  MaterialNames names_;
};

MaterialMap material_map(const PaintedGround& ground, const PaperPalette& materials) {
  MaterialIndex material_of[ground_class_count];
  for (std::size_t i = 0; i < ground_class_count; ++i) material_of[i] = materials.of(static_cast<GroundClass>(i));
  MaterialMap map{.grid = ground.grid(), .material = Array2D<MaterialIndex>(ground.grid().columns, ground.grid().rows)};
  for (std::size_t row = 0; row < map.grid.rows; ++row) {
    for (std::size_t column = 0; column < map.grid.columns; ++column) {
      map.material(column, row) = material_of[static_cast<std::size_t>(ground.cell(column, row))];
    }
  }
  return map;
}

TreePrototypes add_tree_prototypes(Scene& scene, TreeMaterials materials) {
  const auto first = static_cast<std::uint32_t>(scene.prototypes.size());
  for (std::uint32_t i = 0; i < broadleaf_prototypes; ++i)
    scene.prototypes.push_back(tree_mesh(TreeForm::Broadleaf, materials, i));
  for (std::uint32_t i = 0; i < conifer_prototypes; ++i)
    scene.prototypes.push_back(tree_mesh(TreeForm::Conifer, materials, i));
  return {.first_broadleaf = first,
          .broadleaf_count = broadleaf_prototypes,
          .first_conifer = first + broadleaf_prototypes,
          .conifer_count = conifer_prototypes};
}

VehiclePrototypes add_vehicle_prototypes(Scene& scene, MaterialIndex body) {
  const auto first = static_cast<std::uint32_t>(scene.prototypes.size());
  for (const VehicleKind kind : {VehicleKind::Car, VehicleKind::Van, VehicleKind::Truck})
    scene.prototypes.push_back(vehicle_mesh(kind, body));
  return {.car = first, .van = first + 1, .truck = first + 2};
}

void append(std::vector<Instance>& instances, const std::vector<Instance>& more) {
  instances.insert(instances.end(), more.begin(), more.end());
}

}  // namespace

PaperSceneSize paper_scene_size(double scale) {
  const auto counted = [&](double at_full_scale) {
    return static_cast<std::size_t>(std::llround(at_full_scale * scale * scale));
  };
  return {.side_m = 2000.0 * scale,
          .height_nodes = nearest_power_of_two(512.0 * scale) + 1,
          .material_cells = nearest_power_of_two(4096.0 * scale),
          .trees = counted(70'928.0),
          .buildings = counted(2082.0)};
}

Scene paper_scene(const PaperSceneOptions& options) {
  if (!(options.scale >= smallest_scale && options.scale <= largest_scale)) {
    throw Error("paper scene", fmt::format("scale {} is out of range", options.scale),
                fmt::format("give a scale from {} to {}", smallest_scale, largest_scale));
  }
  const PaperLayout layout = paper_layout(options);
  PaperLandscape landscape = paper_landscape(layout);
  Scene scene;
  scene.name = fmt::format("paper scene, scale {}, seed {}", options.scale, options.seed);
  const PaperPalette materials(scene, options.materials);
  scene.buildings.mesh.name = "buildings";
  const PaperTown town = paper_town(layout, landscape, materials.town());
  for (const RoofedBuilding& shape : town.buildings) {
    Interruption::heed();
    append_roofed_building(scene.buildings, shape, footing_m(landscape.terrain, shape));
  }
  append(scene.instances, paper_trees(layout, landscape, town, add_tree_prototypes(scene, materials.tree())));
  append(scene.instances,
         paper_traffic(layout, landscape, town, add_vehicle_prototypes(scene, materials.index("metal"))));
  scene.ground = material_map(landscape.ground, materials);
  scene.terrain = std::move(landscape.terrain);
  scene.extent = scene.terrain.extent();
  // Laid out about the origin; patches of an atlas count from it, so a corner there lets one patch hold the scene.
  shift(scene, {-scene.extent.west_m, -scene.extent.south_m});
  return scene;
}

}  // namespace sigmascape::scene
