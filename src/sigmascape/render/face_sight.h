#pragma once

#include <cstddef>

#include "sigmascape/base/array2d.h"
#include "sigmascape/base/vec.h"
#include "sigmascape/radar/curved_earth.h"
#include "sigmascape/radar/ground_grid.h"
#include "sigmascape/radar/obstacle.h"
#include "sigmascape/terrain/height_field.h"

namespace sigmascape::render {

/// What of an echo of a wall or roof gets to the radar and back, past terrain and all else that stands on it: a march
/// along the line of sight over squares of obstacles, as far as anything may reach up to it.
///
/// Obstacles know of no walls: the square that holds one is as high as its roof, outside and in. So the march begins
/// before the wall, beyond its own squares.
class FaceSight {
 public:
  /// For faces about which obstacles lie within `about`: what is farther away is looked at square by square. Keeps
  /// references to obstacles and terrain.
  FaceSight(const radar::ObstacleMap& obstacles, const terrain::HeightField& terrain, const radar::Rectangle& about,
            const radar::CurvedEarth& earth = radar::CurvedEarth::flat(), unsigned threads = 1);

  /// The height above which a point about `place` is in sight of a radar over terrain and solid things farther from it
  /// than lines of sight are marched along (`part_passed`): once for many points that are near together.
  [[nodiscard]] double clear_above_m(Vec2d place, Vec3d radar) const;

  /// The part, from 0 to 1, that passes from a point of a face with that normal. `clear_above_m` is of its place.
  [[nodiscard]] double part_passed(Vec3d point, Vec3d normal, Vec3d radar, double clear_above_m) const;

  /// How far lines of sight are marched along at most.
  static constexpr double longest_march_m = 2000.0;

 private:
  /// The way of a line of sight over the ground.
  struct Way;
  /// Of a block of squares.
  struct Block {
    double top_m;  ///< nothing in it, ground or obstacle, is higher
    double end_m;  ///< along the way, where that leaves it
  };

  /// How far a line that rises so is marched along.
  [[nodiscard]] double march_m(double rise) const;
  /// The block over which a way runs there; one without a top where none is known.
  [[nodiscard]] Block block_at(const Way& way, double d) const;

  const radar::ObstacleMap& obstacles_;
  const terrain::HeightField& terrain_;
  radar::CurvedEarth earth_;
  double tallest_m_ = 0.0;                        ///< of the obstacles about, above their ground
  double highest_m_ = 0.0;                        ///< nothing rises above it
  std::size_t first_column_ = 0, first_row_ = 0;  ///< of the blocks that are known, counted in blocks
  Array2D<float> block_top_m_;                    ///< [column, row] of blocks of squares
};

}  // namespace sigmascape::render
