#include "sigmascape/scene/water_level.h"

#include <algorithm>
#include <cmath>

namespace sigmascape::scene {
namespace {

struct NodeRange {
  std::size_t first, last;
};

/// The nodes on both sides of an interval measured in node spacings.
NodeRange nodes_around(double from, double to, std::size_t count) {
  const auto highest = static_cast<double>(count - 1);
  return {static_cast<std::size_t>(std::clamp(std::floor(from), 0.0, highest)),
          static_cast<std::size_t>(std::clamp(std::ceil(to), 0.0, highest))};
}

}  // namespace

std::size_t level_water(terrain::HeightField& terrain, const radar::GroundGrid& grid, const WaterMask& water,
                        double level_m, double within_m) {
  Array2D<float>& heights = terrain.height_m;
  Array2D<std::uint8_t> levelled(heights.columns(), heights.rows(), 0);
  const double cell = grid.cell_m / terrain.spacing_m;
  const double west = (grid.west_m - terrain.west_m) / terrain.spacing_m,
               north = (terrain.north_m - grid.north_m) / terrain.spacing_m;
  for (std::size_t row = 0; row < water.rows(); ++row) {
    for (std::size_t column = 0; column < water.columns(); ++column) {
      if (water(column, row) == 0) continue;
      const double x = west + static_cast<double>(column) * cell, y = north + static_cast<double>(row) * cell;
      const NodeRange across = nodes_around(x, x + cell, heights.columns()),
                      down = nodes_around(y, y + cell, heights.rows());
      for (std::size_t j = down.first; j <= down.last; ++j) {
        for (std::size_t i = across.first; i <= across.last; ++i) {
          if (std::abs(static_cast<double>(heights(i, j)) - level_m) <= within_m) levelled(i, j) = 1;
        }
      }
    }
  }
  std::size_t moved = 0;
  for (std::size_t i = 0; i < heights.size(); ++i) {
    if (levelled.values()[i] == 0) continue;
    heights.values()[i] = static_cast<float>(level_m);
    ++moved;
  }
  return moved;
}

}  // namespace sigmascape::scene
