#pragma once

#include <cstddef>
#include <cstdint>

#include "sigmascape/base/array2d.h"
#include "sigmascape/radar/obstacle.h"
#include "sigmascape/scene/raster_window.h"
#include "sigmascape/terrain/height_field.h"

namespace sigmascape::scene {

/// An instance of a crown that is a medium.
struct StandingCrown {
  Vec3d centre;   ///< in the scene's frame
  Vec3d radii_m;  ///< along its own axes, the third upright
  double cos_yaw = 1.0, sin_yaw = 0.0;
  double extinction_per_m = 0.0;

  /// Half the length of the upright line through it at a place; 0 beside it.
  [[nodiscard]] double half_chord_m(Vec2d place) const;
};

/// The surface of porous things over the parts of squares, in some rows of a grid at a time, and the crowns that stand
/// for it on the squares. What stands on the squares next to them is known too.
class FoliageRaster {
 public:
  /// Of no rows yet; at most so many.
  FoliageRaster(const radar::GroundGrid& squares, std::size_t most_rows);

  /// Holds nothing on these rows. Takes time for what was held.
  void move_to(std::size_t first_row, std::size_t rows);

  /// Adds a triangle, cut until its pieces are as small as the parts. What lies beside them is not cut: the work grows
  /// with the parts that a triangle covers, however large it is.
  void add(const Corners& triangle, const terrain::HeightField& ground);

  /// Adds as much surface as even leaves of that extinction have: docs/physics/vegetation.md, Eq. (1).
  void add(const StandingCrown& crown, const terrain::HeightField& ground);

  /// Gives an obstacle the crown over a square: from the lowest to the highest surface over it, with the extinction by
  /// which as much passes as between the surfaces over its parts, Eqs. (10), (11).
  void write_to(radar::Obstacle& obstacle, std::size_t column, std::size_t row) const;

  /// The surface over one part.
  struct Foliage {
    double area_m2 = 0.0, base_m = 0.0, top_m = 0.0;
  };

  /// Parts are as small as what branches and leaves crowd into: smaller ones would find the leaves themselves.
  static constexpr double part_m = 0.4;
  static constexpr std::size_t most_parts_per_side = 5;
  [[nodiscard]] static std::size_t bytes(const radar::GroundGrid& squares, std::size_t most_rows);

 private:
  void add_piece(const Corners& piece, const terrain::HeightField& ground);
  void add_surface(std::size_t column, std::size_t row, const Foliage& more);
  /// Of a part; numbers of parts count from the north-western square beside the first one.
  [[nodiscard]] Foliage foliage_of(std::size_t column, std::size_t row) const;

  std::size_t parts_per_side_;
  RasterWindow parts_;
  Array2D<Foliage> foliage_;
  Array2D<std::uint8_t> is_there_;  // on squares, the rows held and those next to them
};

}  // namespace sigmascape::scene
