#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "sigmascape/base/array2d.h"
#include "sigmascape/base/vec.h"
#include "sigmascape/geo/local_frame.h"
#include "sigmascape/radar/channels.h"
#include "sigmascape/radar/ground_grid.h"
#include "sigmascape/scatter/material.h"
#include "sigmascape/terrain/height_field.h"

namespace sigmascape::scene {

/// Index into Scene::materials.
using MaterialIndex = std::uint8_t;

/// What the bare ground is made of, cell by cell.
struct MaterialMap {
  radar::GroundGrid grid;
  Array2D<MaterialIndex> material;  ///< [column, row]

  /// The material under a point; outside the map that of the nearest edge.
  [[nodiscard]] MaterialIndex at(Vec2d point) const;
  /// Those that lie anywhere on it, ascending.
  [[nodiscard]] std::vector<MaterialIndex> materials_laid() const;
};

/// A surface of triangles, each of one material. Both sides scatter.
struct Mesh {
  std::string name;
  std::vector<Vec3f> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::vector<MaterialIndex> materials;  ///< one a triangle
  /// Whether it is a solid obstacle rather than a porous one; where that is not stated its edges tell
  /// (scene/obstacle_raster.h). Traced rays meet its triangles either way.
  std::optional<bool> is_solid{};
};

struct Ellipsoid {
  Vec3f centre;
  Vec3f radii_m{1.0F, 1.0F, 1.0F};
};

/// Leaves as a medium within an ellipsoid, about the branches of a prototype: every instance of the prototype has it.
struct Crown {
  std::uint32_t prototype = 0;
  Ellipsoid shape;           ///< in the prototype's frame
  MaterialIndex medium = 0;  ///< a material of CrownParameters
  /// Whether its leaves grow with the tree, so that its extinction is by metres of the prototype and as much passes
  /// through a large tree as through a small one. Otherwise it is by metres in the world.
  bool grows_with_tree = false;

  /// What the extinction is multiplied by in a tree of that Instance::size.
  [[nodiscard]] float extinction_scale(float size) const { return grows_with_tree ? 1.0F / size : 1.0F; }
};

/// One placement of a prototype (a tree, a vehicle, a tower). Its origin stands on the ground, wherever that is: on the
/// terrain, or on the plane z = 0 where a bake is told to take the ground as level.
struct Instance {
  std::uint32_t prototype = 0;
  float x_m = 0.0F, y_m = 0.0F;
  float lift_m = 0.0F;   ///< height of the origin above the ground
  float yaw_rad = 0.0F;  ///< clockwise from north: where the prototype's +y axis points
  Vec3f scale{1.0F, 1.0F, 1.0F};
  float speed_mps = 0.0F;  ///< along the prototype's +y axis

  /// Over that of the prototype: the cube root of the volume it is scaled by.
  [[nodiscard]] float size() const { return std::cbrt(scale.x * scale.y * scale.z); }
};

/// A building among Scene::buildings: a run of vertices that share one footing.
struct Building {
  std::uint32_t first_vertex = 0;
  std::uint32_t vertex_count = 0;
  float footing_m = 0.0F;  ///< terrain height under its lowest corner, or that of the whole of which it is a piece:
                           ///< what z = 0 of its vertices stands for on the terrain
};

/// All buildings in one mesh; vertex z is the height above the building's own footing.
struct Buildings {
  Mesh mesh;
  std::vector<Building> items;
};

/// An echo of known cross-section at a point, where a shape is not known or not wanted.
struct PointTarget {
  std::string name;
  Vec2d position;
  double height_m = 0.0;  ///< above the ground
  radar::Channels rcs_m2;
};

/// Those of the buildings whose numbers among `items` are given, in that order, with what of the mesh is theirs; of
/// what belongs to no building nothing.
[[nodiscard]] Buildings part_of(const Buildings& buildings, std::span<const std::uint32_t> numbers);

/// The least rectangle that holds a building; of no vertices one that meets nothing.
[[nodiscard]] radar::Rectangle extent_of(const Buildings& buildings, const Building& building);

/// Something that was left out or mended while reading a scene.
struct Remark {
  std::string what;  ///< "self-crossing footprints repaired"
  std::size_t count = 0;
  std::string first;  ///< the first one, by file and feature
  /// Rather than what data are like: those who go on to work with the scene are warned of it.
  bool is_likely_a_mistake = false;
};

/// What the radar looks at, in one local frame: x east, y north, z up, metres.
struct Scene {
  std::string name;
  geo::LocalFrame frame;
  radar::Rectangle extent;
  terrain::HeightField terrain;
  MaterialMap ground;
  std::vector<scatter::Material> materials;
  std::vector<Mesh> prototypes;
  std::vector<Crown> crowns;
  std::vector<Instance> instances;
  Buildings buildings;
  std::vector<PointTarget> point_targets;
  std::vector<Remark> remarks;
  std::string attribution;

  /// Index of the material of that name, added from `material` when the scene does not have it yet.
  MaterialIndex material_index(const scatter::Material& material);
};

/// Moves everything in the scene east and north by `offset`, within the same frame.
void shift(Scene& scene, Vec2d offset);

/// Height of the highest vertex of a mesh above its origin, 0 when none stands above it.
[[nodiscard]] float top_m(const Mesh& mesh);

/// The same of each prototype of a scene, its crown included.
[[nodiscard]] std::vector<float> prototype_tops_m(const Scene& scene);

/// How far each prototype of a scene reaches from its origin over the ground, unscaled, its crown included.
[[nodiscard]] std::vector<float> prototype_radii_m(const Scene& scene);

/// Which of its materials something is made of, the ground included.
[[nodiscard]] std::vector<bool> used_materials(const Scene& scene);

/// Height of the tallest thing above its ground, in metres: what decides how far shadows and layover reach.
[[nodiscard]] double tallest_object_m(const Scene& scene);

/// The scene's extent, and as much around it as anything takes up that stands outside.
[[nodiscard]] radar::Rectangle occupied_extent(const Scene& scene);

/// A digest of everything that affects how the scene scatters: the same for equal scenes, another after any change.
/// Point targets have their own: maps show them, but textures do not hold them.
[[nodiscard]] std::string scene_hash(const Scene& scene);
/// A digest of its point targets; empty where it has none.
[[nodiscard]] std::string targets_hash(const Scene& scene);

}  // namespace sigmascape::scene
