#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "sigmascape/base/vec.h"
#include "sigmascape/base/worker_team.h"
#include "sigmascape/live/horizon_grid.h"
#include "sigmascape/terrain/terrain_view.h"

namespace sigmascape::live {

struct RasterSettings {
  /// Pixels that a triangle covers on level ground: the paper asks for 16 or more.
  double pixels_per_triangle = 16.0;
  std::size_t longest_side = 8192;  ///< of the picture, in pixels; finer pixels than it allows are not made
};

/// The paper's way to visible ground: terrain as triangles in a z-buffer.
///
/// The view is oblique: its plane is parallel to the ground and its centre of projection is the radar, so that pixels
/// cover equal areas of level ground near and far. A point is drawn where its line of sight meets the plane, and of
/// two points on one line of sight the higher is nearer: depth is 1 / (radar height − height), linear over the picture.
class TerrainRaster {
 public:
  /// Draws all terrain that can hide or be part of the grid's ground; what the view looks at must live until the next.
  /// Returns the number of triangles left out because they reach up to the radar.
  std::size_t draw(const Vec3d& radar, const HorizonGrid& grid, const terrain::TerrainView& view,
                   const RasterSettings& settings, WorkerTeam& team);

  /// Whether a point of the drawn terrain is seen: unless a triangle drawn next to it, other than its own, lies over
  /// it.
  [[nodiscard]] bool sees(Vec2d point) const;

  [[nodiscard]] std::size_t columns() const { return tiles_across_ * tile_side; }
  [[nodiscard]] std::size_t rows() const { return tiles_down_ * tile_side; }

  static constexpr std::size_t tile_side = 64;

 private:
  /// Where the picture lies: pixels along and across the middle azimuth, from the radar's foot.
  struct Picture {
    Vec2d outwards, rightwards;
    double plane_m = 0.0;  ///< height of the view's plane
    double pixels_per_m = 1.0;
    double left_m = 0.0, near_m = 0.0;
  };
  struct Projected {
    float x, y, nearness;
  };

  [[nodiscard]] Projected project(Vec2d point, double height_m) const;
  void place_picture(const HorizonGrid& grid, const RasterSettings& settings);
  void sort_blocks();
  [[nodiscard]] std::uint32_t drawn_at(float x, float y) const {
    return triangle_[static_cast<std::size_t>(y > 0.0F ? y : 0.0F) * columns() +
                     static_cast<std::size_t>(x > 0.0F ? x : 0.0F)];
  }

  Vec3d radar_;
  terrain::TerrainView view_;
  double drop_per_square_m_ = 0.0;
  Picture picture_;
  std::size_t tiles_across_ = 0, tiles_down_ = 0;
  std::vector<float> x_, y_, nearness_;                  ///< of the nodes
  std::vector<std::uint32_t> tile_begin_, tile_blocks_;  ///< which blocks of terrain touch a tile
  std::vector<std::uint32_t> triangle_;                  ///< [row][column] of the picture: the nearest triangle
};

}  // namespace sigmascape::live
