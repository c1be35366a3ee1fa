#pragma once

#include <cstddef>

#include "sigmascape/base/array2d.h"
#include "sigmascape/base/vec.h"
#include "sigmascape/radar/curved_earth.h"
#include "sigmascape/radar/ground_grid.h"
#include "sigmascape/radar/obstacle.h"
#include "sigmascape/radar/straight_sight.h"
#include "sigmascape/radar/vantage.h"
#include "sigmascape/render/skyline.h"
#include "sigmascape/terrain/height_field.h"

namespace sigmascape::render {

/// What of an echo of a wall or roof gets to the radar and back, past terrain and all else that stands on it. Whether
/// its line of sight passes over all that is solid the skyline before it tells; of the few that do not pass over all
/// crowns too, the way within these is summed along the line.
///
/// Obstacles know of no walls: the square that holds one is as high as its roof, outside and in. So a wall's line of
/// sight begins before it, beyond its own squares.
class FaceSight {
 public:
  /// For faces within an area. Keeps references to obstacles and terrain.
  FaceSight(const radar::ObstacleMap& obstacles, const terrain::HeightField& terrain, const radar::Vantage& vantage,
            const radar::Rectangle& area, const radar::CurvedEarth& earth = radar::CurvedEarth::flat(),
            unsigned threads = 1);

  /// The part, from 0 to 1, that passes from a point of a face with that normal to `radar`, where the vantage has it
  /// for the face.
  [[nodiscard]] double part_passed(Vec3d point, Vec3d normal, Vec3d radar) const;

 private:
  /// Of a block of squares.
  struct Block {
    double top_m;  ///< no crown in it is higher
    double end_m;  ///< along the way, where that leaves it
  };

  void find_crowns(const radar::Rectangle& about, unsigned threads);
  /// Whether something solid that is known no better than to `doubt_m` hides the way there.
  [[nodiscard]] bool is_hidden_at(const radar::StraightSight& way, double d, double doubt_m) const;
  [[nodiscard]] double part_through_crowns(const radar::StraightSight& way) const;
  /// The block over which a way runs there; one without crowns where none is known.
  [[nodiscard]] Block block_at(const radar::StraightSight& way, double d) const;

  const radar::ObstacleMap& obstacles_;
  const terrain::HeightField& terrain_;
  radar::CurvedEarth earth_;
  Skyline skyline_;
  std::size_t first_column_ = 0, first_row_ = 0;  ///< of the blocks that are known, counted in blocks
  Array2D<float> crown_top_m_;                    ///< [column, row] of blocks of squares
  double highest_crown_m_ = 0.0;                  ///< of these
};

}  // namespace sigmascape::render
