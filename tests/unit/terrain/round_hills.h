#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "sigmascape/base/units.h"
#include "sigmascape/base/vec.h"
#include "sigmascape/terrain/height_field.h"
#include "sigmascape/terrain/terrain_view.h"

namespace sigmascape::terrain {

/// Hills that are round everywhere, h = A cos κx cos κy, whose slopes are known in closed form.
struct RoundHills {
  double height_m = 80.0;  ///< A
  double kappa_per_m = 2.0 * pi / 1600.0;
  double spacing_m = 5.0;  ///< of the field's nodes

  [[nodiscard]] double at(Vec2d p) const {
    return height_m * std::cos(kappa_per_m * p.x) * std::cos(kappa_per_m * p.y);
  }
  /// Eastward and northward.
  [[nodiscard]] Vec2d slope_at(Vec2d p) const {
    const double x = kappa_per_m * p.x, y = kappa_per_m * p.y, steepest = height_m * kappa_per_m;
    return {-steepest * std::sin(x) * std::cos(y), -steepest * std::cos(x) * std::sin(y)};
  }

  [[nodiscard]] HeightField field(std::size_t columns, std::size_t rows) const {
    HeightField field{
        .west_m = -1000.0, .north_m = 2000.0, .spacing_m = spacing_m, .height_m = Array2D<float>(columns, rows)};
    for (std::size_t row = 0; row < rows; ++row) {
      for (std::size_t column = 0; column < columns; ++column) {
        field.height_m(column, row) =
            static_cast<float>(at({field.west_m + static_cast<double>(column) * field.spacing_m,
                                   field.north_m - static_cast<double>(row) * field.spacing_m}));
      }
    }
    return field;
  }

  /// How far the slopes of a level of the field's pyramid may be off, whose nodes are D apart.
  ///
  /// Central differences at nodes lack at most D²/6 of the third derivative, Aκ³, and linear ones between nodes D²/8 of
  /// it for each of the two ways. A coarser level's nodes are means of the finer ones about them, 1 2 1 both ways,
  /// which takes hills down by cos²(κd/2) each way. Then there is half a step of packing. What the nearest node has is
  /// off by up to D/2 of the second derivative, Aκ², each way.
  [[nodiscard]] double slope_error(int level) const {
    double node_m = spacing_m, left = 1.0;
    for (int finer = 0; finer < level; ++finer, node_m *= 2.0)
      left *= std::pow(std::cos(0.5 * kappa_per_m * node_m), 4.0);
    return node_m * node_m * height_m * std::pow(kappa_per_m, 3.0) * (1.0 / 6.0 + 2.0 / 8.0) +
           height_m * kappa_per_m * (1.0 - left) + 0.5 / static_cast<double>(PackedSlope::steps_per_unit);
  }
};

}  // namespace sigmascape::terrain
