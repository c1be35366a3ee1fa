#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "sigmascape/radar/ground_grid.h"
#include "sigmascape/scene/scene.h"
#include "sigmascape/trace/launch_ring.h"
#include "sigmascape/trace/launch_shares.h"
#include "sigmascape/trace/multibounce_reach.h"
#include "sigmascape/trace/scene_geometry.h"
#include "sigmascape/trace/viewpoint.h"

namespace sigmascape::trace {

/// A cell of the launch lattice: squares of the plane that rays are aimed at, numbered from the origin of the local
/// frame, so that the same place always has the same rays, whichever patch or shard asks.
struct LaunchCell {
  std::int32_t i = 0;  ///< eastward: covers x from i · cell to (i + 1) · cell
  std::int32_t j = 0;  ///< northward
  /// Which part of the rays that cells of the target get is enough here: halved with every ring about the target.
  float share = 1.0F;
};

/// Cells whose echoes travel to the receiver together: squares of the lattice, or what an area has of them.
inline constexpr int tile_side_cells = 16;
inline constexpr std::size_t cells_per_tile = std::size_t{tile_side_cells} * tile_side_cells;
/// Number of tiles that so many cells make.
[[nodiscard]] constexpr std::size_t tiles_of(std::size_t cells) {
  return (cells + cells_per_tile - 1) / cells_per_tile;
}

/// What a radar at a place hears: between two ranges and within so much of a direction.
struct HeardSector {
  Vec3d radar;
  double middle_azimuth_rad = 0.0, half_width_rad = 0.0;
  double near_range_m = 0.0, far_range_m = 0.0;

  /// Whether a path that begins at that point may be heard, or one so far from it.
  [[nodiscard]] bool is_heard_from(Vec3d point, const MultibounceReach& reach, double spare_m) const;
};

/// From which cells echoes can come that land in an area of interest.
struct LaunchArea {
  double cell_m = 1.0;
  double plane_height_m = 0.0;    ///< height of the plane aimed at
  double top_height_m = 0.0;      ///< rays start at this height, above everything
  double highest_m = 0.0;         ///< paths that count begin no higher: cells are listed for these
  int grain = 1;                  ///< squares of so many cells a side are launched all or not at all
  std::vector<LaunchCell> cells;  ///< in tiles of 16 × 16, for the sake of caches

  /// Number of tiles that the tracer hands to its sink, one by one.
  [[nodiscard]] std::size_t tiles() const { return tiles_of(cells.size()); }
  /// The cells, each for as much as its share.
  [[nodiscard]] double whole_cells() const;

  /// How far from where paths may begin the line of sight through a grain's centre may pass: where the centre stays out
  /// its cells may not.
  [[nodiscard]] double rim_m() const { return grain == 1 ? cell_m : 0.5 * grain_m(); }
  [[nodiscard]] double grain_m() const { return cell_m * grain; }
  /// How far beside the rings paths may begin that count. Cells that are launched together tell of one another's noise,
  /// whichever target asks, and beside one that sees a roof is one that sees the ground behind its shadow.
  [[nodiscard]] double counting_rim_m() const { return grain == 1 ? cell_m : 32.0; }

  /// LaunchCell::share at that point of the plane; 0 where nothing is launched.
  [[nodiscard]] float share_at(Vec2d point) const;
  /// Whether paths that begin at such a surface point count: whether its own echo can land in the outermost ring
  /// or its rim.
  /// Rays that were aimed behind the target to meet what is tall mostly meet ground that nobody asked for.
  [[nodiscard]] bool counts_from(Vec3d first_vertex) const;
  /// Whether all paths count whose rays are aimed at these cells, whatever they meet.
  [[nodiscard]] bool counts_always(std::span<const LaunchCell> aimed_at) const;

  Viewpoint viewpoint;
  radar::Rectangle target;  ///< the area of interest
  MultibounceReach reach;   ///< how far from it paths may begin
  /// Where the direct echoes land of those surface points that paths begin at, each within the next.
  std::vector<LaunchRing> rings;
  LaunchShares shares;                    ///< of the squares of a grain each
  std::optional<HeardSector> heard = {};  ///< of the area of interest, where the radar does not hear all of it
};

/// The outline of a launch area, whose cells are still to be listed. See launch_area.
[[nodiscard]] LaunchArea launch_outline(const Viewpoint& viewpoint, const radar::Rectangle& target, double cell_m,
                                        double plane_height_m, double top_height_m, const MultibounceReach& reach,
                                        int grain = 1);

/// How much of the plane the rays of an outline are aimed at: where paths that land in the target may begin, and behind
/// that along the lines of sight as far as these pass below the highest. Without end where the radar stands hardly
/// above it.
[[nodiscard]] double aimed_area_m2(const LaunchArea& outline);

/// Lists the cells of an outline whose aimed_area_m2 is no more than some 2³⁰ of them. Below the top some come with
/// them whose rays meet what counts no more.
void list_cells(LaunchArea& outline);

/// The launch area for echoes that land in `target`, whose aimed_area_m2 is no more than some 2³⁰ cells.
///
/// A surface at height h above the plane is hit by rays aimed h cot ψ behind it and lands h tan ψ before it, so aim
/// points reach h_max (cot ψ + tan ψ) behind the target, each along its own line of sight where the radar has a place.
/// Paths of several bounces may begin as far from the target as `reach` says. Ever fewer rays are asked for out there,
/// half as many with every doubling of the distance, for ever less of what begins there lands in the target.
/// `grain` is 1, or tile_side_cells where every tile is to be whole.
[[nodiscard]] LaunchArea launch_area(const Viewpoint& viewpoint, const radar::Rectangle& target, double cell_m,
                                     double plane_height_m, double top_height_m, const MultibounceReach& reach,
                                     int grain = 1);

class RingsInSight;

/// Follows the rays of an area down to what stands there. Takes out the grains from which no path begins that counts:
/// whose rays pass above all that stands where such paths begin, or only get there where they would be below it. Where
/// all that rays can meet lands in an outer ring, they get that ring's share; an area of one ring brings back the same
/// to the last bit.
void spare_rays(LaunchArea& area, const RingsInSight& sight);
void spare_rays(LaunchArea& area, const scene::Scene& scene, Footing footing);

/// Takes out of an area of a radar at a place what does not come to be heard: the cells whose rays pass beside the
/// sector and what lies within reach of it, and all paths that begin there (LaunchArea::counts_from).
void narrow_to(LaunchArea& area, const HeardSector& heard);

}  // namespace sigmascape::trace
