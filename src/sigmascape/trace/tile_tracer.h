#pragma once

#include <cstdint>
#include <span>
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
class TileTracer final : public TilePaths {
 public:
  /// Everything is held by reference and has to outlive the tracer.
  TileTracer(const SceneGeometry& geometry, const SpectralSurfaces& surfaces, const Viewpoint& viewpoint,
             const PathOptions& options, const LaunchArea& area, std::span<const LaunchCell> cells, std::uint64_t seed);

  [[nodiscard]] std::span<const LaunchCell> cells() const override { return cells_; }
  void follow(const LaunchCell& cell, std::uint32_t sequence, std::uint32_t sample) override;
  [[nodiscard]] std::span<const radar::Echo> echoes(std::size_t frequency) const override { return echoes_[frequency]; }
  [[nodiscard]] const TraceCounts& counts() const { return counts_; }

 private:
  /// Follows the path that is aimed at `aim` and stands for `area_m2` of the launch plane.
  void trace_path(Vec2d aim, double area_m2, const SobolPoint& point);
  /// Two numbers in [0, 1) that belong together: where in the cell, or the direction after a bounce.
  [[nodiscard]] Vec2f drawn_pair(const SobolPoint& point, std::uint32_t bounce) const;
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
  std::span<const LaunchCell> cells_;
  std::uint64_t seed_;
  std::vector<std::vector<radar::Echo>> echoes_;  // of the path at hand, [frequency]
  TraceCounts counts_;
  Path path_;
  std::vector<scatter::FieldPair> out_;  // towards the radar, one a frequency
};

}  // namespace sigmascape::trace
