#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <span>

#include "sigmascape/scene/scene.h"
#include "sigmascape/trace/crown_crossings.h"
#include "sigmascape/trace/ray_log.h"
#include "sigmascape/trace/surroundings.h"

namespace sigmascape::trace {

/// What the objects of a scene stand on: its own terrain, or the level plane z = 0 on which reflectivity is baked.
enum class Footing { Terrain, LevelPlane };

struct SurfaceHit {
  Vec3f position;
  Vec3f normal;                            ///< unit, on the side that the ray came from
  float inverse_facet_area_per_m2 = 0.0F;  ///< of the face that was hit, 0 on the ground
  scene::MaterialIndex material = 0;
  /// Of the crown within which a path was intercepted: no surface, and without a normal. Zero on surfaces.
  float extinction_per_m = 0.0F;

  [[nodiscard]] bool is_in_crown() const { return extinction_per_m > 0.0F; }
  bool is_ground = false;    ///< whether the terrain or the level plane was hit
  bool is_building = false;  ///< whether one of Scene::buildings was
};

struct SceneHeights;
struct SceneStructures;

/// A scene made ready for rays: the one place that knows Embree.
///
/// Everything is held relative to `origin()`, the centre of the scene's extent at height zero, so that single precision
/// suffices. Trees, vehicles and other instances share one acceleration structure a prototype. Crowns that are media
/// are crossed, never hit. The level plane is intersected in closed form (no cracks); terrain is a robustly traversed
/// grid that is only hit from above. Either goes on for 300 m beyond the edges of the scene's terrain.
class SceneGeometry {
 public:
  /// Throws Error when the terrain and what rays need over it take more memory than this machine has.
  SceneGeometry(const scene::Scene& scene, Footing footing);
  /// Of what matters alone to paths that begin in a place: memory goes by that, not by the scene.
  SceneGeometry(const scene::Scene& scene, Footing footing, const Surroundings& around);
  /// The same with the scene's heights on that footing, which take a look at everything in it to find.
  SceneGeometry(const scene::Scene& scene, Footing footing, const Surroundings& around, const SceneHeights& heights);
  ~SceneGeometry();
  SceneGeometry(SceneGeometry&&) noexcept;
  SceneGeometry& operator=(SceneGeometry&&) noexcept;

  [[nodiscard]] Footing footing() const;
  [[nodiscard]] Vec3d origin() const;
  /// Heights between which everything of the scene lies.
  [[nodiscard]] double lowest_m() const;
  [[nodiscard]] double highest_m() const;

  /// Finds the first surface along the ray; `origin` and the hit's position are relative to origin(). However far the
  /// ray comes from, the position is as exact as single precision holds it, the ray itself only to the step of its
  /// start.
  [[nodiscard]] bool intersect(Vec3f ray_origin, Vec3f direction, SurfaceHit& hit) const;
  [[nodiscard]] bool occluded(Vec3f ray_origin, Vec3f direction) const;

  /// The same for many rays at once, which is faster, with the same answers to the bit; only where faces of several
  /// objects coincide, another one of them may be met. `meets` and `is_occluded` get 1 for yes, 0 for no. Not for
  /// scenes with crowns.
  void intersect(std::span<const Ray> rays, std::span<SurfaceHit> hits, std::span<std::uint8_t> meets,
                 RayOrder order = RayOrder::ByPlace) const;
  void occluded(std::span<const Ray> rays, std::span<std::uint8_t> is_occluded) const;

  [[nodiscard]] bool has_crowns() const;
  /// The same two, adding to `crowns` those that the ray crosses, be it behind the surface.
  [[nodiscard]] bool intersect(Vec3f ray_origin, Vec3f direction, SurfaceHit& hit, CrownCrossings& crowns) const;
  /// With `length_m`, of what is no farther along the ray; crowns that reach beyond it are noted whole.
  [[nodiscard]] bool occluded(Vec3f ray_origin, Vec3f direction, CrownCrossings& crowns,
                              float length_m = std::numeric_limits<float>::infinity()) const;

  /// Notes every ray from now on, until it is given null. Not for several threads at once.
  void log_to(RayLog* log);
  /// Traces such rays and nothing else: those that were asked for together in the packets that they were traced in
  /// then, single ones in packets where neighbours ask alike. Returns how many met something, so that the work cannot
  /// be left out.
  [[nodiscard]] std::size_t replay(const RayLog& log) const;

  /// Bytes that the acceleration structures take.
  [[nodiscard]] std::size_t memory_bytes() const;

 private:
  [[nodiscard]] bool intersect(const Ray& ray, SurfaceHit& hit, CrownCrossings* crowns) const;
  [[nodiscard]] bool occluded(const Ray& ray, CrownCrossings* crowns, float length_m) const;
  std::unique_ptr<SceneStructures> structures_;
};

/// Rays of this thread treat denormal numbers as zero while the object lives, as Embree asks.
class FlushDenormals {
 public:
  FlushDenormals();
  ~FlushDenormals();
  FlushDenormals(const FlushDenormals&) = delete;
  FlushDenormals& operator=(const FlushDenormals&) = delete;

 private:
  unsigned saved_;
};

}  // namespace sigmascape::trace
