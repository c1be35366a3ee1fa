#pragma once

#include <cstddef>

#include "sigmascape/base/array2d.h"
#include "sigmascape/base/vec.h"
#include "sigmascape/radar/ground_grid.h"

namespace sigmascape::radar {

/// What `raster`, [column, row] of the grid, holds at a point; outside the grid a value made of nothing.
template <typename Value>
[[nodiscard]] Value value_at(const GroundGrid& grid, const Array2D<Value>& raster, Vec2d point) {
  const Vec2d cell = grid.cells_from(point);
  if (!(cell.x >= 0.0 && cell.y >= 0.0 && cell.x < static_cast<double>(grid.columns) &&
        cell.y < static_cast<double>(grid.rows))) {
    return {};
  }
  return raster(static_cast<std::size_t>(cell.x), static_cast<std::size_t>(cell.y));
}

}  // namespace sigmascape::radar
