#include "sigmascape/scene/water_level.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

namespace sigmascape::scene {
namespace {

using terrain::NodeMask;

struct NodeRange {
  std::size_t first, last;
};

/// The nodes on both sides of an interval measured in node spacings.
NodeRange nodes_around(double from, double to, std::size_t count) {
  const auto highest = static_cast<double>(count - 1);
  return {static_cast<std::size_t>(std::clamp(std::floor(from), 0.0, highest)),
          static_cast<std::size_t>(std::clamp(std::ceil(to), 0.0, highest))};
}

/// The nodes that bear on the height of a water cell.
NodeMask nodes_under(const WaterMask& water, const radar::GroundGrid& grid, const terrain::HeightField& terrain) {
  NodeMask under(terrain.height_m.columns(), terrain.height_m.rows(), 0);
  const double cell = grid.cell_m / terrain.spacing_m;
  const double west = (grid.west_m - terrain.west_m) / terrain.spacing_m,
               north = (terrain.north_m - grid.north_m) / terrain.spacing_m;
  for (std::size_t row = 0; row < water.rows(); ++row) {
    for (std::size_t column = 0; column < water.columns(); ++column) {
      if (water(column, row) == 0) continue;
      const double x = west + static_cast<double>(column) * cell, y = north + static_cast<double>(row) * cell;
      const NodeRange across = nodes_around(x, x + cell, under.columns()),
                      down = nodes_around(y, y + cell, under.rows());
      for (std::size_t j = down.first; j <= down.last; ++j) {
        for (std::size_t i = across.first; i <= across.last; ++i) under(i, j) = 1;
      }
    }
  }
  return under;
}

/// Water without heights of its own, in one piece.
struct Pool {
  std::vector<std::size_t> nodes;        ///< numbers of those, row by row
  bool reaches_edge = false;             ///< of the terrain
  std::optional<double> lowest_shore_m;  ///< of ground with heights
};

/// The pool about a node; what is in it is taken off those that are `left` of all pools' nodes. Of its shore what was
/// filled tells nothing.
Pool pool_about(std::size_t first, const NodeMask& filled, NodeMask& left, const Array2D<float>& heights) {
  Pool pool;
  const auto take = [&](std::size_t node) {
    left.values()[node] = 0;
    pool.nodes.push_back(node);
  };
  take(first);
  for (std::size_t at = 0; at < pool.nodes.size(); ++at) {
    const std::size_t column = pool.nodes[at] % left.columns(), row = pool.nodes[at] / left.columns();
    const NodeRange across{std::max<std::size_t>(column, 1) - 1, std::min(column + 1, left.columns() - 1)},
        down{std::max<std::size_t>(row, 1) - 1, std::min(row + 1, left.rows() - 1)};
    pool.reaches_edge = pool.reaches_edge || across.last - across.first < 2 || down.last - down.first < 2;
    for (std::size_t j = down.first; j <= down.last; ++j) {
      for (std::size_t i = across.first; i <= across.last; ++i) {
        if (left(i, j) != 0) take(j * left.columns() + i);
        if (filled(i, j) == 0) {
          const auto shore_m = static_cast<double>(heights(i, j));
          pool.lowest_shore_m = std::min(pool.lowest_shore_m.value_or(shore_m), shore_m);
        }
      }
    }
  }
  return pool;
}

std::vector<Pool> pools_in(const NodeMask& under_water, const NodeMask& filled, const Array2D<float>& heights) {
  NodeMask left(under_water.columns(), under_water.rows());
  std::ranges::transform(under_water.values(), filled.values(), left.values().begin(),
                         [](auto under, auto hole) -> std::uint8_t { return under != 0 && hole != 0 ? 1 : 0; });
  std::vector<Pool> found;
  for (std::size_t node = 0; node < left.size(); ++node) {
    if (left.values()[node] != 0) found.push_back(pool_about(node, filled, left, heights));
  }
  return found;
}

}  // namespace

std::size_t level_water(terrain::HeightField& terrain, const NodeMask& filled, const radar::GroundGrid& grid,
                        const WaterMask& water, double level_m, double within_m) {
  Array2D<float>& heights = terrain.height_m;
  NodeMask levelled = nodes_under(water, grid, terrain);
  const std::vector<Pool> pools = pools_in(levelled, filled, heights);
  for (std::size_t i = 0; i < heights.size(); ++i) {
    if (std::abs(static_cast<double>(heights.values()[i]) - level_m) > within_m) levelled.values()[i] = 0;
  }
  for (const Pool& pool : pools) {
    if (!pool.reaches_edge && pool.lowest_shore_m.value_or(level_m) > level_m + within_m) continue;
    for (const std::size_t node : pool.nodes) levelled.values()[node] = 1;
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
