#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "sigmascape/radar/ground_grid.h"
#include "sigmascape/scene/scene.h"
#include "sigmascape/trace/scene_geometry.h"
#include "sigmascape/trace/viewpoint.h"

namespace sigmascape::trace {

/// A cell of the launch lattice: squares of the plane that rays are aimed at, numbered from the origin of the local
/// frame, so that the same place always has the same rays, whichever patch or shard asks.
struct LaunchCell {
  std::int32_t i = 0;  ///< eastward: covers x from i · cell to (i + 1) · cell
  std::int32_t j = 0;  ///< northward
};

/// Cells whose echoes travel to the receiver together: squares of the lattice, or what an area has of them.
inline constexpr int tile_side_cells = 16;
inline constexpr std::size_t cells_per_tile = std::size_t{tile_side_cells} * tile_side_cells;

/// What a radar at a place hears: between two ranges and within so much of a direction.
struct HeardSector {
  Vec3d radar;
  double middle_azimuth_rad = 0.0, half_width_rad = 0.0;
  double near_range_m = 0.0, far_range_m = 0.0;

  /// Whether a point lies in it, or no more than `margin_m` beside it.
  [[nodiscard]] bool holds(Vec3d point, double margin_m) const;
};

/// From which cells echoes can come that land in an area of interest.
struct LaunchArea {
  double cell_m = 1.0;
  double plane_height_m = 0.0;    ///< height of the plane aimed at
  double top_height_m = 0.0;      ///< rays start at this height, above everything
  int grain = 1;                  ///< squares of so many cells a side are launched all or not at all
  std::vector<LaunchCell> cells;  ///< in tiles of 16 × 16, for the sake of caches

  /// Number of tiles that the tracer hands to its sink, one by one.
  [[nodiscard]] std::size_t tiles() const { return (cells.size() + cells_per_tile - 1) / cells_per_tile; }

  /// How far from the target the line of sight through a grain's centre may pass: where the centre stays out of the
  /// target its cells may not.
  [[nodiscard]] double rim_m() const { return margin_m + (grain == 1 ? cell_m : 0.5 * cell_m * grain); }

  /// Whether a ray through that point of the plane could have been launched.
  [[nodiscard]] bool covers(Vec2d point) const;
  /// Whether paths that begin at such a surface point count: whether its echo can land in the target or its margin.
  /// Rays that were aimed behind the target to meet what is tall mostly meet ground that nobody asked for.
  [[nodiscard]] bool counts_from(Vec3d first_vertex) const;

  Viewpoint viewpoint;
  radar::Rectangle target;                ///< the area of interest
  double margin_m = 0.0;                  ///< how far around it paths may begin
  std::optional<HeardSector> heard = {};  ///< of the area of interest, where the radar does not hear all of it
};

/// Takes out of an area the grains from which no path begins that counts: whose rays pass above all that stands where
/// such paths begin, or only get there where they would be below it. What the area brings back stays the same to the
/// last bit, and LaunchArea::covers still speaks of the area as it was, which for paths that count is the same.
void leave_out_idle_cells(LaunchArea& area, const scene::Scene& scene, Footing footing);

/// Takes out of an area of a radar at a place what does not come to be heard: the cells whose rays pass beside the
/// sector and its margin, and all paths that begin there (LaunchArea::counts_from).
void narrow_to(LaunchArea& area, const HeardSector& heard);

/// The launch area for echoes that land in `target`.
///
/// A surface at height h above the plane is hit by rays aimed h cot ψ behind it and lands h tan ψ before it, so aim
/// points reach h_max (cot ψ + tan ψ) behind the target, each along its own line of sight where the radar has a place.
/// `margin_m` widens the target on all sides for echoes of several bounces, which land midway between their ends.
/// `grain` is 1, or tile_side_cells where every tile is to be whole.
[[nodiscard]] LaunchArea launch_area(const Viewpoint& viewpoint, const radar::Rectangle& target, double cell_m,
                                     double plane_height_m, double top_height_m, double margin_m, int grain = 1);

}  // namespace sigmascape::trace
