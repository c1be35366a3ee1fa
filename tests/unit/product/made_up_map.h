#pragma once

#include <cstddef>
#include <functional>
#include <limits>

#include "sigmascape/radar/ground_map.h"

namespace sigmascape::product {

inline constexpr float unseen_power = std::numeric_limits<float>::quiet_NaN();

/// A map of 2 m cells whose VV power is a function of the cell; the other channels are zero.
inline radar::GroundMap map_of(std::size_t columns, std::size_t rows,
                               const std::function<double(std::size_t column, std::size_t row)>& vv,
                               double cell_m = 2.0) {
  radar::GroundMap map;
  map.grid = {.west_m = 100.0, .north_m = 200.0, .cell_m = cell_m, .columns = columns, .rows = rows};
  map.sigma0 = Array2D<radar::Channels>(columns, rows);
  for (std::size_t row = 0; row < rows; ++row) {
    for (std::size_t column = 0; column < columns; ++column) {
      map.sigma0(column, row).vv = static_cast<float>(vv(column, row));
    }
  }
  return map;
}

}  // namespace sigmascape::product
