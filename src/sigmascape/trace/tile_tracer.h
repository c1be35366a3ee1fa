#pragma once

#include <cstdint>
#include <vector>

#include "sigmascape/base/sobol.h"
#include "sigmascape/radar/echo.h"
#include "sigmascape/scatter/surface_model.h"
#include "sigmascape/trace/launch.h"
#include "sigmascape/trace/path.h"
#include "sigmascape/trace/path_tracer.h"
#include "sigmascape/trace/scene_geometry.h"

namespace sigmascape::trace {

/// Follows the paths of a tile, one by one, on one thread.
class TileTracer {
 public:
  /// Everything is held by reference and has to outlive the tracer; `echoes` has a list for each frequency.
  TileTracer(const SceneGeometry& geometry, const SpectralSurfaces& surfaces, const Viewpoint& viewpoint,
             const PathOptions& options, const LaunchArea& area, std::vector<std::vector<radar::Echo>>& echoes,
             TraceCounts& counts);

  /// Follows the path that is aimed at `aim` and stands for `area_m2` of the launch plane.
  void trace_path(Vec2d aim, double area_m2, const SobolPoint& point);

 private:
  void launch_towards(Vec3d aim_point, const SobolPoint& point);
  void begin_at(Vec3d position, Vec3f normal);
  void add_direct_echoes(const SurfaceHit& hit, Vec3d position, Vec3d aim_point, double area_m2);
  void add_connected_echoes(const SurfaceHit& hit, Vec3d position, Vec3d aim_point, double area_m2, int bounce,
                            const SobolPoint& point);
  [[nodiscard]] float reciprocal_share(const SurfaceHit& hit, Vec3d position, Vec3f to_radar, float last_cosine) const;
  [[nodiscard]] bool carry_on(const SurfaceHit& hit, int bounce, const SobolPoint& point);
  [[nodiscard]] bool survives_roulette(float u);
  void append(std::size_t frequency, const radar::Echo& echo);

  const SceneGeometry& geometry_;
  const SpectralSurfaces& surfaces_;
  const Viewpoint& viewpoint_;
  const PathOptions& options_;
  const LaunchArea& area_;
  std::vector<std::vector<radar::Echo>>& echoes_;
  TraceCounts& counts_;
  Path path_;
  std::vector<scatter::FieldPair> out_;  // towards the radar, one a frequency
};

}  // namespace sigmascape::trace
