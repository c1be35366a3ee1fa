#include "sigmascape/product/same_cells.h"

#include <cmath>
#include <fmt/format.h>

#include "sigmascape/base/error.h"
#include "sigmascape/geo/coordinate_reference_system.h"

namespace sigmascape::product {

void require_same_cells(const radar::GroundMap& tested, const radar::GroundMap& truth) {
  const auto differ = [](const std::string& how) {
    throw Error("maps to compare", how, "render both onto the same grid of the same frame");
  };
  const radar::GroundGrid& a = tested.grid;
  const radar::GroundGrid& b = truth.grid;
  if (a.cell_m != b.cell_m)
    differ(fmt::format("the tested map's cells are {} m, the truth's {} m", a.cell_m, b.cell_m));
  if (a.columns != b.columns || a.rows != b.rows) {
    differ(fmt::format("the tested map has {} x {} cells, the truth {} x {}", a.columns, a.rows, b.columns, b.rows));
  }
  if (a.west_m != b.west_m || a.north_m != b.north_m) {
    differ(fmt::format("the tested map's north-western corner is ({}, {}) m, the truth's ({}, {}) m", a.west_m,
                       a.north_m, b.west_m, b.north_m));
  }
  if (!geo::is_same_crs(tested.crs, truth.crs)) {
    differ(fmt::format("the tested map lies in the frame '{}', the truth in '{}'", tested.crs, truth.crs));
  }
}

std::size_t block_factor(double cell_m, const radar::GroundGrid& grid) {
  const double factor = cell_m / grid.cell_m;
  const double whole = std::round(factor);
  // More cells than a side of any map has, few enough for a whole number.
  constexpr double largest = 1e9;
  return whole >= 1.0 && whole <= largest && std::abs(factor - whole) < 1e-6 * whole ? static_cast<std::size_t>(whole)
                                                                                     : 0;
}

std::size_t required_block_factor(double cell_m, const radar::GroundGrid& grid) {
  const std::size_t factor = block_factor(cell_m, grid);
  if (factor > 0) return factor;
  throw Error("cell size to compare at",
              fmt::format("{} m is no multiple of the maps' {} m cells", cell_m, grid.cell_m),
              "choose whole multiples of the maps' cell");
}

}  // namespace sigmascape::product
