#pragma once

#include <cstddef>
#include <vector>

#include "sigmascape/base/array2d.h"
#include "sigmascape/base/vec.h"
#include "sigmascape/radar/ground_grid.h"
#include "sigmascape/terrain/height_field.h"

namespace sigmascape::bake {

/// How high terrain rises at most within squares of it, from single cells to all of it, so that lines of sight high
/// above the ground need not look at each height under them.
class HighestGround {
 public:
  /// Keeps a reference.
  explicit HighestGround(const terrain::HeightField& relief);

  struct Square {
    radar::Rectangle extent;
    double highest_m = 0.0;  ///< of its ground, edges included
  };
  /// The square of a level, 0 the finest, that a point of the terrain falls into. Those of the last hold all of it.
  [[nodiscard]] Square around(Vec2d point, std::size_t level) const;
  [[nodiscard]] std::size_t levels() const { return 1 + above_cells_.size(); }
  /// Of all the terrain.
  [[nodiscard]] double highest_m() const;

 private:
  [[nodiscard]] double highest_of_cell_m(std::size_t column, std::size_t row) const;

  const terrain::HeightField& relief_;
  std::vector<Array2D<float>> above_cells_;  // of level 1 and coarser, the last of one square; level 0 is the cells
};

}  // namespace sigmascape::bake
