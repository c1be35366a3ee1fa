#pragma once

#include <cstddef>
#include <vector>

#include "sigmascape/base/vec.h"
#include "sigmascape/radar/curved_earth.h"
#include "sigmascape/render/ground_samples.h"
#include "sigmascape/render/terrain_raster.h"
#include "sigmascape/terrain/terrain_view.h"

namespace sigmascape::render {

/// Two ways to the same answer; docs/decisions/0035-visible-ground.md compares them.
enum class VisibilityMethod {
  HorizonSweep,   ///< walk outwards along every azimuth with the steepest line of sight met so far
  Rasterization,  ///< draw the terrain as triangles into a z-buffer in the paper's oblique view, then look points up
};

struct VisibleGroundSettings {
  VisibilityMethod method = VisibilityMethod::HorizonSweep;
  radar::CurvedEarth earth = {};
  /// Longest step of the sweep, in cells of the terrain, up to 1. Ridges run along the sides of cells, where the sweep
  /// looks in any case; smaller steps find what bulges within a cell.
  double longest_step_cells = 0.5;
  /// Whether the grazing angle above the slope and the slope's area are wanted.
  bool local_slopes = true;
  RasterSettings raster = {};
  /// 1 works in the calling thread, without taking memory; 0 takes one thread a hardware thread.
  unsigned threads = 1;
};

struct VisibleGroundCounts {
  std::size_t samples = 0;             ///< points of the sector
  std::size_t on_terrain = 0;          ///< of them those that the terrain reaches to
  std::size_t visible = 0;             ///< of these those that nothing hides
  std::size_t triangles_left_out = 0;  ///< drawn terrain that stands too high for the oblique view
};

/// Finds which ground a radar sees, at what height, range and grazing angle.
///
/// The ground is the bilinear surface of the view over a curved Earth; only it hides ground. Results do not depend on
/// the number of threads. Keeps its working memory from call to call: one object for each renderer.
class VisibleGround {
 public:
  explicit VisibleGround(const VisibleGroundSettings& settings = {}) : settings_(settings) {}

  [[nodiscard]] const VisibleGroundSettings& settings() const { return settings_; }

  /// Fills `found`, which is fitted to the sector. `radar` stands in the view's frame, height above sea level. For
  /// Rasterization it must stand above all terrain: what reaches up to it is left out and counted.
  VisibleGroundCounts find(const Vec3d& radar, const GroundSector& sector, const terrain::TerrainView& view,
                           GroundSamples& found);

 private:
  VisibleGroundSettings settings_;
  std::vector<float> per_distance_, lowered_m_, height_term_m_, sea_range_squared_m2_, sea_range_m_;
  TerrainRaster raster_;
};

}  // namespace sigmascape::render
