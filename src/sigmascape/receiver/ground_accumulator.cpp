#include "sigmascape/receiver/ground_accumulator.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace sigmascape::receiver {

GroundAccumulator::Axis::Axis(double start_m, double cell_m)
    : cell_m_(cell_m), first_(std::floor(start_m / cell_m)), offset_(start_m / cell_m - first_) {}

double GroundAccumulator::Axis::cell_of(double position_m) const {
  // Rounded down like this, for std::floor is a call where vector units may be old. What is too far away for an integer
  // is in no grid.
  const double cell = position_m / cell_m_ - offset_;
  if (!(std::abs(cell) < 0x1p52)) return std::numeric_limits<double>::infinity();
  const auto whole = static_cast<double>(static_cast<std::int64_t>(cell));
  return (whole > cell ? whole - 1.0 : whole) - first_;
}

GroundAccumulator::GroundAccumulator(const radar::GroundGrid& grid)
    : grid_(grid),
      eastward_(grid.west_m, grid.cell_m),
      southward_(-grid.north_m, grid.cell_m),
      bins_(grid.columns, grid.rows),
      variances_(grid.columns * grid.rows) {}

std::optional<std::uint32_t> GroundAccumulator::cell_at(Vec2d point) const {
  const double column = eastward_.cell_of(point.x), row = southward_.cell_of(-point.y);
  if (column < 0.0 || row < 0.0 || column >= static_cast<double>(grid_.columns) ||
      row >= static_cast<double>(grid_.rows)) {
    return std::nullopt;
  }
  return static_cast<std::uint32_t>(static_cast<std::size_t>(row) * grid_.columns + static_cast<std::size_t>(column));
}

void GroundAccumulator::add(std::uint32_t cell, const radar::Channels& rcs_m2, double variance_m4) {
  bins_.add(cell % grid_.columns, cell / grid_.columns, rcs_m2);
  if (variance_m4 > 0.0) variances_.add(cell, variance_m4);
}

Array2D<radar::Channels> GroundAccumulator::sigma0() const {
  Array2D<radar::Channels> sigma0 = bins_.sums();
  const auto per_area = static_cast<float>(1.0 / grid_.cell_area_m2());
  for (radar::Channels& cell : sigma0.values()) cell = cell * per_area;
  return sigma0;
}

Array2D<double> GroundAccumulator::sigma0_variances() const {
  Array2D<double> variances(grid_.columns, grid_.rows);
  const double area_m2 = grid_.cell_area_m2();
  const Array2D<radar::Channels> powers = sigma0();
  for (std::size_t i = 0; i < variances.size(); ++i) {
    // Of dark cells variances are rounded up to more than they can be.
    const auto power = static_cast<double>(powers.values()[i].power(radar::Polarization::Sum));
    variances.values()[i] = std::min(variances_.sum(i) / (area_m2 * area_m2), power * power);
  }
  return variances;
}

}  // namespace sigmascape::receiver
