#include "sigmascape/scene/scene.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "sigmascape/base/error.h"
#include "sigmascape/base/sha256.h"
#include "sigmascape/radar/rectangle_parts.h"

namespace sigmascape::scene {
namespace {

/// Feeds the constants of each law of permittivity.
struct LawHasher {
  Sha256& sha;
  void operator()(const scatter::PowerLawPermittivity& p) const {
    for (const double value : {p.a, p.b, p.c, p.d}) sha.add_value(value);
  }
  void operator()(const scatter::WaterPermittivity& p) const {
    for (const double value : {p.temperature_c, p.salinity_g_per_kg}) sha.add_value(value);
  }
  void operator()(const scatter::SoilPermittivity& p) const {
    for (const double value :
         {p.sand_percent, p.clay_percent, p.volumetric_moisture, p.temperature_c, p.specific_gravity})
      sha.add_value(value);
  }
  void operator()(const scatter::VegetationPermittivity& p) const {
    for (const double value : {p.gravimetric_moisture, p.salinity_g_per_kg}) sha.add_value(value);
  }
};

void add_permittivity(Sha256& sha, const scatter::Permittivity& p) {
  sha.add_value(p.law().index());
  std::visit(LawHasher{sha}, p.law());
}

void add_depolarization(Sha256& sha, const scatter::Depolarization& d) {
  sha.add_value(d.cross_ratio);
  sha.add_value(d.vv_hh_correlation);
}

/// Feeds the constants of each model; a new model adds its overload here and the compiler insists on it.
struct ModelHasher {
  Sha256& sha;
  void operator()(const scatter::LambertParameters& m) const {
    sha.add_value(m.albedo);
    add_depolarization(sha, m.depolarization);
  }
  void operator()(const scatter::ConstantGammaParameters& m) const {
    sha.add_value(m.gamma);
    add_depolarization(sha, m.depolarization);
    sha.add_value(static_cast<int>(m.frequency_law));
  }
  void operator()(const scatter::UlabyDobsonParameters& m) const {
    sha.add_value(static_cast<int>(m.terrain));
    sha.add_value(static_cast<int>(m.unverified_rows));
    add_depolarization(sha, m.depolarization);
  }
  void operator()(const scatter::BillingsleyParameters& m) const {
    sha.add_value(static_cast<int>(m.terrain));
    add_depolarization(sha, m.depolarization);
  }
  void operator()(const scatter::NrlSeaParameters& m) const {
    sha.add_value(m.sea_state);
    add_depolarization(sha, m.depolarization);
  }
  void operator()(const scatter::GitSeaParameters& m) const {
    for (const double value : {m.sea_state, m.wind_angle_rad, m.wind_speed_mps}) sha.add_value(value);
    add_depolarization(sha, m.depolarization);
  }
  void operator()(const scatter::CookTorranceParameters& m) const {
    add_permittivity(sha, m.permittivity);
    sha.add_value(m.alpha);
    sha.add_value(static_cast<int>(m.distribution));
    sha.add_value(m.scattering_coefficient);
    add_depolarization(sha, m.depolarization);
    sha.add_value(static_cast<int>(m.masking));
    sha.add_value(static_cast<int>(m.multiple_scatter));
  }
  void operator()(const scatter::CrownParameters& m) const {
    sha.add_value(m.extinction_per_m);
    sha.add_value(m.albedo);
    sha.add_value(static_cast<int>(m.shares_gaps));
    sha.add_value(static_cast<int>(m.leaf.has_value()));
    if (m.leaf) add_permittivity(sha, *m.leaf);
    add_depolarization(sha, m.depolarization);
  }
};

void add_mesh(Sha256& sha, const Mesh& mesh) {
  sha.add_values(std::span<const Vec3f>(mesh.vertices));
  sha.add_values(std::span<const std::array<std::uint32_t, 3>>(mesh.triangles));
  sha.add_values(std::span<const MaterialIndex>(mesh.materials));
}

void add_grid(Sha256& sha, double west, double north, double step, std::size_t columns, std::size_t rows) {
  for (const double value : {west, north, step}) sha.add_value(value);
  sha.add_value(columns);
  sha.add_value(rows);
}

}  // namespace

MaterialIndex MaterialMap::at(Vec2d point) const {
  const Vec2d cells = grid.cells_from(point);
  const auto column = static_cast<std::size_t>(std::clamp(cells.x, 0.0, static_cast<double>(grid.columns) - 0.5));
  const auto row = static_cast<std::size_t>(std::clamp(cells.y, 0.0, static_cast<double>(grid.rows) - 0.5));
  return material(column, row);
}

std::vector<MaterialIndex> MaterialMap::materials_laid() const {
  std::array<bool, std::numeric_limits<MaterialIndex>::max() + 1> is_laid{};
  for (const MaterialIndex laid : material.values()) is_laid[laid] = true;
  std::vector<MaterialIndex> materials;
  for (std::size_t index = 0; index < is_laid.size(); ++index) {
    if (is_laid[index]) materials.push_back(static_cast<MaterialIndex>(index));
  }
  return materials;
}

MaterialIndex Scene::material_index(const scatter::Material& material) {
  const auto known = std::ranges::find_if(materials, [&](const scatter::Material& other) {
    return other.name == material.name && other.model == material.model;
  });
  if (known != materials.end()) return static_cast<MaterialIndex>(known - materials.begin());
  if (materials.size() > 255)
    throw Error("scene " + name, "more than 256 materials", "share materials between objects");
  materials.push_back(material);
  return static_cast<MaterialIndex>(materials.size() - 1);
}

Buildings part_of(const Buildings& buildings, std::span<const std::uint32_t> numbers) {
  constexpr std::uint32_t absent = ~0U;
  const Mesh& all = buildings.mesh;
  Buildings part;
  part.mesh.name = all.name;
  std::vector<std::uint32_t> number_in_part(all.vertices.size(), absent);
  for (const std::uint32_t number : numbers) {
    Building building = buildings.items[number];
    const std::uint32_t first = building.first_vertex;
    building.first_vertex = static_cast<std::uint32_t>(part.mesh.vertices.size());
    for (std::uint32_t i = 0; i < building.vertex_count; ++i) {
      number_in_part[first + i] = building.first_vertex + i;
      part.mesh.vertices.push_back(all.vertices[first + i]);
    }
    part.items.push_back(building);
  }
  for (std::size_t t = 0; t < all.triangles.size(); ++t) {
    const auto& [a, b, c] = all.triangles[t];
    if (number_in_part[a] == absent) continue;
    part.mesh.triangles.push_back({number_in_part[a], number_in_part[b], number_in_part[c]});
    part.mesh.materials.push_back(all.materials[t]);
  }
  return part;
}

radar::Rectangle extent_of(const Buildings& buildings, const Building& building) {
  constexpr float far = std::numeric_limits<float>::infinity();
  float west = far, south = far, east = -far, north = -far;
  for (const Vec3f& vertex : std::span(buildings.mesh.vertices).subspan(building.first_vertex, building.vertex_count)) {
    west = std::min(west, vertex.x);
    south = std::min(south, vertex.y);
    east = std::max(east, vertex.x);
    north = std::max(north, vertex.y);
  }
  return {west, south, east, north};
}

void shift(Scene& scene, Vec2d offset) {
  const auto east = static_cast<float>(offset.x), north = static_cast<float>(offset.y);
  auto& extent = scene.extent;
  extent = radar::moved(extent, offset);
  scene.terrain.west_m += offset.x;
  scene.terrain.north_m += offset.y;
  scene.ground.grid.west_m += offset.x;
  scene.ground.grid.north_m += offset.y;
  for (Instance& instance : scene.instances) {
    instance.x_m += east;
    instance.y_m += north;
  }
  for (Vec3f& vertex : scene.buildings.mesh.vertices) vertex += {east, north, 0.0F};
  for (PointTarget& target : scene.point_targets) target.position = target.position + offset;
}

float top_m(const Mesh& mesh) {
  float top = 0.0F;
  for (const Vec3f& vertex : mesh.vertices) top = std::max(top, vertex.z);
  return top;
}

std::vector<float> prototype_tops_m(const Scene& scene) {
  std::vector<float> tops;
  for (const Mesh& prototype : scene.prototypes) tops.push_back(top_m(prototype));
  for (const Crown& crown : scene.crowns) {
    tops[crown.prototype] = std::max(tops[crown.prototype], crown.shape.centre.z + crown.shape.radii_m.z);
  }
  return tops;
}

std::vector<float> prototype_radii_m(const Scene& scene) {
  std::vector<float> radii;
  for (const Mesh& prototype : scene.prototypes) {
    radii.push_back(0.0F);
    for (const Vec3f& vertex : prototype.vertices)
      radii.back() = std::max(radii.back(), std::hypot(vertex.x, vertex.y));
  }
  for (const Crown& crown : scene.crowns) {
    const auto& [centre, radii_m] = crown.shape;
    float& radius = radii[crown.prototype];
    radius = std::max(radius, std::hypot(centre.x, centre.y) + std::max(radii_m.x, radii_m.y));
  }
  return radii;
}

double tallest_object_m(const Scene& scene) {
  const std::vector<float> prototype_top = prototype_tops_m(scene);
  float tallest = top_m(scene.buildings.mesh);
  for (const Instance& instance : scene.instances) {
    tallest = std::max(tallest, instance.lift_m + instance.scale.z * prototype_top[instance.prototype]);
  }
  return tallest;
}

std::vector<bool> used_materials(const Scene& scene) {
  std::vector<bool> used(scene.materials.size(), false);
  for (const MaterialIndex material : scene.ground.material.values()) used[material] = true;
  for (const MaterialIndex material : scene.buildings.mesh.materials) used[material] = true;
  std::vector<bool> is_placed(scene.prototypes.size(), false);
  for (const Instance& instance : scene.instances) is_placed[instance.prototype] = true;
  for (std::size_t prototype = 0; prototype < scene.prototypes.size(); ++prototype) {
    if (!is_placed[prototype]) continue;
    for (const MaterialIndex material : scene.prototypes[prototype].materials) used[material] = true;
  }
  for (const Crown& crown : scene.crowns) {
    if (is_placed[crown.prototype]) used[crown.medium] = true;
  }
  return used;
}

radar::Rectangle occupied_extent(const Scene& scene) {
  radar::Rectangle occupied = scene.extent;
  const auto take_in = [&](double x, double y, double about) {
    occupied = {std::min(occupied.west_m, x - about), std::min(occupied.south_m, y - about),
                std::max(occupied.east_m, x + about), std::max(occupied.north_m, y + about)};
  };
  for (const Vec3f& vertex : scene.buildings.mesh.vertices)
    take_in(static_cast<double>(vertex.x), static_cast<double>(vertex.y), 0.0);
  const std::vector<float> radii = prototype_radii_m(scene);
  for (const Instance& instance : scene.instances) {
    const float radius = radii[instance.prototype] * std::max(instance.scale.x, instance.scale.y);
    take_in(static_cast<double>(instance.x_m), static_cast<double>(instance.y_m), static_cast<double>(radius));
  }
  return occupied;
}

std::string scene_hash(const Scene& scene) {
  Sha256 sha;
  sha.add(scene.frame.proj());
  for (const double value : {scene.extent.west_m, scene.extent.south_m, scene.extent.east_m, scene.extent.north_m})
    sha.add_value(value);
  const auto& terrain = scene.terrain;
  add_grid(sha, terrain.west_m, terrain.north_m, terrain.spacing_m, terrain.height_m.columns(),
           terrain.height_m.rows());
  sha.add_values(terrain.height_m.values());
  const auto& grid = scene.ground.grid;
  add_grid(sha, grid.west_m, grid.north_m, grid.cell_m, grid.columns, grid.rows);
  sha.add_values(scene.ground.material.values());
  for (const auto& material : scene.materials) {
    sha.add_value(material.model.index());
    std::visit(ModelHasher{sha}, material.model);
  }
  for (const Mesh& mesh : scene.prototypes) {
    add_mesh(sha, mesh);
    if (mesh.is_solid) sha.add_value(*mesh.is_solid);
  }
  for (const Crown& crown : scene.crowns) {
    sha.add_value(crown.prototype);
    sha.add_value(crown.medium);
    sha.add_value(crown.grows_with_tree);
    for (const Vec3f v : {crown.shape.centre, crown.shape.radii_m}) {
      for (const float value : {v.x, v.y, v.z}) sha.add_value(value);
    }
  }
  for (const Instance& i : scene.instances) {
    sha.add_value(i.prototype);
    for (const float value : {i.x_m, i.y_m, i.lift_m, i.yaw_rad, i.scale.x, i.scale.y, i.scale.z, i.speed_mps})
      sha.add_value(value);
  }
  add_mesh(sha, scene.buildings.mesh);
  for (const Building& b : scene.buildings.items) {
    sha.add_value(b.first_vertex);
    sha.add_value(b.vertex_count);
    sha.add_value(b.footing_m);
  }
  return sha.hex_digest();
}

std::string targets_hash(const Scene& scene) {
  if (scene.point_targets.empty()) return "";
  Sha256 sha;
  for (const PointTarget& t : scene.point_targets) {
    for (const double value : {t.position.x, t.position.y, t.height_m}) sha.add_value(value);
    for (const float value : {t.rcs_m2.vv, t.rcs_m2.hh, t.rcs_m2.hv, t.rcs_m2.re_vvhh}) sha.add_value(value);
  }
  return sha.hex_digest();
}

}  // namespace sigmascape::scene
