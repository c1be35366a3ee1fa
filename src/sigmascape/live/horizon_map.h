#pragma once

#include <cstddef>
#include <vector>

#include "sigmascape/base/vec.h"
#include "sigmascape/live/horizon_grid.h"
#include "sigmascape/live/occluders.h"

namespace sigmascape::live {

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

  /// Raises the horizon along one direction to that of the sea, which hides what is beyond it whatever ground is there.
  /// `sweep` does; after slopes have come another way it is left to do.
  void rise_to_sea(std::size_t azimuth, Vec3d radar, const Occluders& occluders);

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
