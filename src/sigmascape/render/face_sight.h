#pragma once

#include "sigmascape/base/array2d.h"
#include "sigmascape/base/vec.h"
#include "sigmascape/radar/curved_earth.h"
#include "sigmascape/radar/obstacle.h"
#include "sigmascape/terrain/height_field.h"

namespace sigmascape::render {

/// What of an echo of a wall or roof gets to the radar and back, past terrain and all else that stands on it: a march
/// along the line of sight over squares of obstacles, as far as anything may reach up to it.
///
/// Obstacles know of no walls: the square that holds one is as high as its roof, outside and in. So the march begins
/// where a wall faces, beyond its own square.
class FaceSight {
 public:
  /// Keeps references to all of them.
  FaceSight(const radar::ObstacleMap& obstacles, const terrain::HeightField& terrain,
            const radar::CurvedEarth& earth = radar::CurvedEarth::flat());

  /// Of what stands on the ground.
  [[nodiscard]] double tallest_m() const { return tallest_m_; }

  /// The height above which a point about `place` is in sight of a radar over what lies farther from it than lines of
  /// sight are marched along (`part_passed`): once for many points that are near together.
  [[nodiscard]] double clear_above_m(Vec2d place, Vec3d radar) const;

  /// The part, from 0 to 1, that passes from a point of a face with that normal. `clear_above_m` is of its place.
  [[nodiscard]] double part_passed(Vec3d point, Vec3d normal, Vec3d radar, double clear_above_m) const;

 private:
  /// The way of a line of sight over the ground.
  struct Way;
  /// How far a line that rises so is marched along.
  [[nodiscard]] double march_m(double rise) const;
  [[nodiscard]] bool is_free_of_block(Vec2d place, double height_m) const;

  const radar::ObstacleMap& obstacles_;
  const terrain::HeightField& terrain_;
  radar::CurvedEarth earth_;
  double tallest_m_ = 0.0;      ///< of the obstacles, above their ground
  double highest_m_ = 0.0;      ///< nothing rises above it
  Array2D<float> block_top_m_;  ///< [column, row] of blocks of squares: the highest of ground and obstacles there
};

}  // namespace sigmascape::render
