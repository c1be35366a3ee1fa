#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "sigmascape/live/shortage.h"
#include "sigmascape/live/terrain_windows.h"
#include "sigmascape/terrain/terrain_pyramid.h"
#include "sigmascape/terrain/terrain_view.h"
#include "sigmascape/terrain/terrain_window.h"

namespace sigmascape::live {

/// The terrain of live frames: tiles of all levels, of which any number may lie on disk, read for pages of ground as
/// they are made, and joined in windows for what hides ground. Of a level of the textures all that is seen and all that
/// hides is the surface of one and the same level of the terrain: ground of one and ridges of another would hide each
/// other wherever they cross. Safe to use from any number of threads.
class LiveTerrain {
 public:
  /// The budget is that of the windows; tiles have the pyramid's own.
  LiveTerrain(std::shared_ptr<terrain::TerrainPyramid> pyramid, std::size_t budget_bytes);

  /// The level that belongs to texels, or to steps, of a size.
  [[nodiscard]] int level_for(double texel_m) const;
  [[nodiscard]] terrain::HeightBounds bounds_over(const radar::Rectangle& ground) const {
    return pyramid_->bounds_over(ground);
  }
  /// Level 0; reads a tile if need be. Beyond the terrain that of its nearest edge.
  [[nodiscard]] double height_at(Vec2d point) const;
  /// Heights over an area, and what of them cannot be had, so that coarser ones stand in.
  struct Window {
    terrain::TerrainWindow nodes;
    Shortage shortage;
  };
  /// Of the level that belongs to texels of a size or of the finest whose nodes are no more than the square of so many.
  /// Reads tiles.
  [[nodiscard]] Window window_over(const radar::Rectangle& area, double texel_m, std::size_t most_nodes_a_side) const;

  /// Heights at the centres of cells, [row][column], north up, of the level that belongs to their size. Reads tiles;
  /// gives back what of them cannot be had, so that coarser ones stand in.
  Shortage fill_heights(const radar::GroundGrid& cells, std::span<float> height_m) const;
  /// And slopes, those of the finest level of its facets.
  Shortage fill_slopes(const radar::GroundGrid& cells, std::span<terrain::PackedSlope> slope) const;

  /// The ground as one frame has it.
  struct Surface {
    terrain::TerrainView view;
    float error_m = 0.0F;  ///< by how much it may lie above or below the ground of the level asked for
    /// And as much above or below that which pages of the level stand on: where a tile cannot be had at all, they stand
    /// on its parent as well.
    float above_pages_m = 0.0F;
  };
  /// The best there is of an area, with bounds of its heights. What would have been better is added to
  /// `wanted`, as far as its memory goes. The surface lives as long as `there`.
  [[nodiscard]] Surface surface(const TerrainWindows::View& there, int level, const radar::Rectangle& area,
                                std::vector<WindowWish>& wanted) const;
  /// By how much a point lies below the ground for sure, as a surface of `level` that reaches to it tells with what it
  /// may be wrong by; 0 above it, and beyond the terrain. Reads nothing.
  [[nodiscard]] double depth_below(const Surface& surface, int level, Vec3d point) const;
  [[nodiscard]] TerrainWindows& windows() { return windows_; }

  [[nodiscard]] const terrain::TerrainPyramid& pyramid() const { return *pyramid_; }

 private:
  [[nodiscard]] Window ground_under(const radar::GroundGrid& cells) const;
  [[nodiscard]] Shortage shortage_of(const terrain::WindowReport& report) const;

  std::shared_ptr<terrain::TerrainPyramid> pyramid_;
  std::shared_ptr<const terrain::HeightTile> coarsest_;
  TerrainWindows windows_;
};

}  // namespace sigmascape::live
