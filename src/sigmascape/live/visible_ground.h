#pragma once

#include <cstddef>

#include "sigmascape/base/vec.h"
#include "sigmascape/base/worker_team.h"
#include "sigmascape/live/horizon_map.h"
#include "sigmascape/live/terrain_raster.h"

namespace sigmascape::live {

/// Two ways to the same answer; docs/decisions/0035-visible-ground.md compares them.
enum class VisibilityMethod {
  HorizonSweep,   ///< walk outwards along every azimuth with the steepest line of sight met so far
  Rasterization,  ///< draw the terrain as triangles into a z-buffer in the paper's oblique view, then look points up
};

struct VisibleGroundSettings {
  VisibilityMethod method = VisibilityMethod::HorizonSweep;
  RasterSettings raster = {};
};

/// Finds which ground a radar sees, one way or the other. What is found is a horizon: what a point at some azimuth and
/// distance must rise above to be seen.
///
/// The ground is the surface of the occluders' view over a curved Earth, bilinear for the sweep, of two triangles a
/// cell for the raster. Results do not depend on the number of threads. Keeps its working memory from call to call.
class VisibleGround {
 public:
  explicit VisibleGround(const VisibleGroundSettings& settings = {}, unsigned workers = 1);

  [[nodiscard]] const VisibleGroundSettings& settings() const { return settings_; }

  /// Says where nodes lie; keeps its memory as long as they need no more of it. Rasterization knows no obstacles.
  void reset(const HorizonGrid& grid, bool with_obstacles) { horizon_.reset(grid, with_obstacles); }

  /// Finds the horizon for azimuths first … first + count − 1 of the grid. For Rasterization the radar must stand above
  /// all terrain: what reaches up to it is left out and counted, and of the occluders only `terrain` is drawn.
  void find(std::size_t first_azimuth, std::size_t count, Vec3d radar, const Occluders& occluders, WorkerTeam& team);

  [[nodiscard]] const HorizonMap& horizon() const { return horizon_; }
  /// Drawn terrain that stands too high for the oblique view.
  [[nodiscard]] std::size_t triangles_left_out() const { return triangles_left_out_; }

 private:
  VisibleGroundSettings settings_;
  HorizonMap horizon_;
  TerrainRaster raster_;
  std::size_t triangles_left_out_ = 0;
};

}  // namespace sigmascape::live
