#pragma once

#include <cstddef>

#include "sigmascape/base/array2d.h"
#include "sigmascape/scene/raster_window.h"
#include "sigmascape/terrain/height_field.h"

namespace sigmascape::scene {

/// Solid things seen from above, at the middles of the parts of squares, in some rows of a grid at a time.
class RoofRaster {
 public:
  /// Of no rows yet; at most so many.
  RoofRaster(const radar::GroundGrid& squares, std::size_t most_rows);

  /// Holds nothing on these rows.
  void move_to(std::size_t first_row, std::size_t rows);
  void add(const Corners& triangle, const terrain::HeightField& ground);

  /// The highest roof over a square that is at least half covered, above the ground below it; else 0.
  [[nodiscard]] float solid_top_m(std::size_t column, std::size_t row) const;

  static constexpr std::size_t parts_per_side = 5;
  static constexpr std::size_t bytes_a_square = parts_per_side * parts_per_side * sizeof(float);

 private:
  RasterWindow parts_;
  Array2D<float> height_m_;
};

}  // namespace sigmascape::scene
