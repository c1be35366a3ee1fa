#pragma once

#include <atomic>
#include <embree3/rtcore.h>
#include <vector>

#include "sigmascape/trace/building_blocks.h"
#include "sigmascape/trace/face_quads.h"
#include "sigmascape/trace/level_plane.h"
#include "sigmascape/trace/placement.h"
#include "sigmascape/trace/ray_packet.h"
#include "sigmascape/trace/scene_geometry.h"
#include "sigmascape/trace/scene_heights.h"
#include "sigmascape/trace/surroundings.h"

namespace sigmascape::trace {

/// What Embree hands on to the crowns that a ray passes.
struct RayContext {
  RTCIntersectContext embree;  // first, since Embree knows no more of it
  CrownCrossings* crowns;
  const float* tree_sizes;  ///< SceneStructures::tree_sizes
};

/// What a top-level geometry of the Embree scene stands for, by its number.
struct Part {
  const FaceTraits* faces = nullptr;  ///< one a quad, areas before scaling; null: the terrain
  Placement placement = {};           ///< of an instance

  [[nodiscard]] bool is_terrain() const { return faces == nullptr; }
};

/// What Embree found at the end of a ray.
struct Found {
  float distance_m;
  Vec3f normal;  ///< of any length and side, in the prototype's frame
  unsigned geometry, primitive, instance;

  [[nodiscard]] bool nothing() const { return geometry == RTC_INVALID_GEOMETRY_ID; }
  [[nodiscard]] unsigned part() const { return instance != RTC_INVALID_GEOMETRY_ID ? instance : geometry; }
};

/// Embree's scene and what its numbers mean.
struct SceneStructures {
  SceneStructures() = default;
  ~SceneStructures();
  SceneStructures(const SceneStructures&) = delete;
  SceneStructures& operator=(const SceneStructures&) = delete;

  void build(const scene::Scene& scene, Footing on, const Surroundings& around, const SceneHeights& heights);

  std::atomic<std::int64_t> memory{0};
  RTCDevice device = nullptr;
  RTCScene top = nullptr;
  std::vector<RTCScene> prototypes, building_blocks;
  std::vector<Part> parts;
  std::vector<scene::Crown> crowns;
  std::vector<float> tree_sizes;  ///< scene::Instance::size of each part that is one; none in scenes without crowns
  scene::MaterialMap ground;
  std::vector<std::vector<FaceTraits>> prototype_faces;
  std::vector<FaceTraits> building_faces;
  Vec3d origin;
  Footing footing = Footing::LevelPlane;
  LevelPlane level_plane;  ///< without extent on terrain
  double lowest_m = 0.0, highest_m = 0.0;
  RayLog* log = nullptr;

  [[nodiscard]] scene::MaterialIndex ground_material(Vec3f position) const {
    return ground.at({position.x + origin.x, position.y + origin.y});
  }
  /// Where a ray meets the level plane; far away where it does not.
  [[nodiscard]] float plane_distance_m(const Ray& ray) const {
    return level_plane.distance_m(ray.origin, ray.direction);
  }
  [[nodiscard]] bool meet(const Ray& ray, const Found& found, SurfaceHit& hit) const;
  /// The same for the first so many rays of a packet; `number_of(lane)` says which they are.
  template <typename NumberOf>
  void meet(const RayPacket& packet, std::size_t lanes, const NumberOf& number_of, std::span<SurfaceHit> hits,
            std::span<std::uint8_t> meets) const;
  /// Those of a packet that have met something far away meet it again from near by.
  void meet_again_from_nearby(RayPacket& packet, RayContext& context) const;
  void hit_plane(const Ray& ray, float distance_m, SurfaceHit& hit) const;

 private:
  void check() const;
  /// Throws Interrupted when the work is told to stop.
  void commit(RTCScene scene);
  void open_device();
  [[nodiscard]] LevelPlane plane_within(const radar::Rectangle& part) const;
  [[nodiscard]] RTCGeometry quads(const std::vector<std::array<std::uint32_t, 4>>& corners,
                                  const std::vector<Vec3f>& vertices) const;
  void attach(RTCGeometry geometry, const Part& part);
  void add_terrain(const terrain::HeightField& field);
  void add_buildings(const scene::Buildings& source, const Surroundings& around);
  void add_buildings(const scene::Buildings& source);
  void add(const BuildingBlock& block);
  /// `transform` column by column: where the prototype's x, y and z axes go, then its origin.
  void add_instance(RTCScene prototype, const std::array<float, 12>& transform, const Part& part);
  void add_prototypes(const std::vector<scene::Mesh>& meshes);
  void attach_crown(RTCScene prototype, scene::Crown& crown);
  void add_instances(const scene::Scene& scene, const Surroundings& around);
};

}  // namespace sigmascape::trace
