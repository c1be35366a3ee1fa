#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "sigmascape/base/vec.h"
#include "sigmascape/live/obstacle_mosaic.h"
#include "sigmascape/terrain/terrain_pyramid.h"
#include "sigmascape/terrain/terrain_view.h"

namespace sigmascape::live {

/// How the nodes of a horizon map lie: along each of a number of directions, evenly spaced over the ground.
struct HorizonGrid {
  double first_azimuth_rad = 0.0;
  double azimuth_step_rad = 1e-3;
  std::size_t azimuths = 0;
  double near_m = 0.0;
  double step_m = 1.0;
  std::size_t distances = 0;
  /// Most steps between the radar and `near_m`: what stands there hides the ground beyond, though it is not mapped.
  /// Steps over obstacles are cut to the size of their squares, here as beyond.
  std::size_t before_near = 256;
  double drop_per_square_m = 0.0;  ///< 1/(2 k R), see radar::CurvedEarth

  /// The last node that is no farther; the first before it, the last beyond all.
  [[nodiscard]] std::size_t node_before(double distance_m) const {
    return static_cast<std::size_t>(
        std::clamp((distance_m - near_m) / step_m, 0.0, static_cast<double>(distances - 1)));
  }

  friend bool operator==(const HorizonGrid&, const HorizonGrid&) = default;
};

/// Single precision leaves this much doubt in a slope.
inline constexpr double slope_doubt = 1e-6;

/// What hides ground.
struct Occluders {
  terrain::TerrainView terrain;
  const ObstacleMosaic* obstacles = nullptr;  ///< null where none stand apart from the textures
  float tallest_m = 0.0F;                     ///< of the obstacles
  terrain::TerrainView before_near = {};      ///< the terrain before the map's first node; empty: the same
  /// The obstacles there, on squares for its steps, which may be longer (`lead_of`); null: the same.
  const ObstacleMosaic* obstacles_before_near = nullptr;
  /// Terrain is taken to lie this much lower than it says: by how much it may be wrong, so that ground is not hidden
  /// by what is not there.
  float lowered_m = 0.0F;
};

/// The steps of a sweep before the map's first node: from the nearest ground that may hide any of the map's.
struct LeadSteps {
  double from_m = 0.0, step_m = 1.0;
  std::size_t count = 0;
};
[[nodiscard]] LeadSteps lead_of(const HorizonGrid& grid, Vec3d radar, const Occluders& occluders);
/// The same of all that may hide the map's ground, known by its bounds alone.
[[nodiscard]] LeadSteps lead_of(const HorizonGrid& grid, Vec3d radar, const terrain::HeightBounds& bounds);

/// The steepest line of sight to the ground met so far, for every direction and distance: what a point must rise above
/// to be seen. Where obstacles stand on the ground, the steepest to solid tops besides, and what part of the ground's
/// echo comes through crowns: walked once for every node, and then good for any number of texels about it.
class HorizonMap {
 public:
  explicit HorizonMap(const HorizonGrid& grid, unsigned workers = 1);

  /// Keeps its memory as long as the new grid needs no more of it.
  void reset(const HorizonGrid& grid, bool with_obstacles);
  [[nodiscard]] const HorizonGrid& grid() const { return grid_; }
  /// Where the azimuths are those of the edges of so many beams, and of lines between them.
  [[nodiscard]] std::size_t azimuths_a_beam(std::size_t beams) const { return (grid_.azimuths - 1) / beams; }

  /// Sweeps outwards along one direction. Directions may be swept by different threads, each with a number of its own.
  void sweep(std::size_t azimuth, Vec3d radar, const Occluders& occluders, unsigned worker = 0);

  /// How far apart in memory the directions lie. No power of two: what lies across them must fit the caches.
  [[nodiscard]] std::size_t stride() const { return stride_; }
  /// Slopes (rise over distance) along one direction: of the steepest line of sight to all ground up to each node.
  [[nodiscard]] const float* slopes(std::size_t azimuth) const { return slopes_.data() + azimuth * stride_; }
  /// To be filled by another way than `sweep`.
  [[nodiscard]] float* slopes(std::size_t azimuth) { return slopes_.data() + azimuth * stride_; }
  /// The same for the tops of solid obstacles; null without obstacles.
  [[nodiscard]] const float* solid_slopes(std::size_t azimuth) const { return row_of(solid_slopes_, azimuth); }
  /// What comes through crowns from the ground of each node, 0 to 1; null without obstacles.
  [[nodiscard]] const float* through(std::size_t azimuth) const { return row_of(through_, azimuth); }
  /// What comes through crowns from a point over a node, under `slope` from the radar: walked for this point alone,
  /// from where its line of sight may meet the first of them. `radar` and `occluders` as of the sweep.
  [[nodiscard]] double through_from(std::size_t azimuth, std::size_t node, double slope, Vec3d radar,
                                    const Occluders& occluders) const;
  /// The same on the way from a node to a point so far away that lies before the next one.
  [[nodiscard]] double through_beyond(std::size_t azimuth, std::size_t node, double distance_m, double slope,
                                      Vec3d radar, const Occluders& occluders) const;
  /// Whether something solid rises above the line of sight under `slope` to a point so far away. `roof_doubt_m`: how
  /// much lower the tops right before it may be than they say (terrain/roof_doubt.h).
  [[nodiscard]] bool is_behind_solid(std::size_t azimuth, double distance_m, double slope, double roof_doubt_m,
                                     Vec3d radar, const Occluders& occluders) const;
  /// Whether ground that no node stands on hides a point under `slope` which the nodes do not: a crest lies between
  /// them here and on one of them there. `across`: the point's azimuth in directions of the map. Goes over the ground
  /// on its own line of sight, where that comes nearer to what the nodes beside it know than the terrain may rise
  /// between them; hardly any other point takes longer for it.
  [[nodiscard]] bool rises_between(double across, double distance_m, double slope, Vec3d radar,
                                   const Occluders& occluders) const;

 private:
  class Walk;
  class Crests;

  /// Over ground on which nothing stands, or only in the textures.
  void sweep_ground(std::size_t azimuth, Vec3d radar, const Occluders& occluders);
  void sweep_obstacles(std::size_t azimuth, Vec3d radar, const Occluders& occluders, unsigned worker);

  [[nodiscard]] const float* row_of(const std::vector<float>& of, std::size_t azimuth) const {
    return with_obstacles_ ? of.data() + azimuth * stride_ : nullptr;
  }

  HorizonGrid grid_;
  std::size_t stride_ = 0;
  bool with_obstacles_ = false;
  std::vector<float> slopes_, solid_slopes_, through_;  // [azimuth][distance], by strides
  std::vector<std::vector<float>> depths_;              // one a worker, see CrownDepth
};

}  // namespace sigmascape::live
