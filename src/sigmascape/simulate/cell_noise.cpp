#include "sigmascape/simulate/cell_noise.h"

#include <algorithm>
#include <cstddef>

namespace sigmascape::simulate {
namespace {

constexpr std::size_t neighbourhood = 2;

/// Noise over that of the median cell from which on a cell gets all rays.
constexpr double full_share = 0.5;

/// The median of those above zero; zero where there are none.
double median_above_zero(std::vector<double> values) {
  std::erase_if(values, [](double value) { return !(value > 0.0); });
  if (values.empty()) return 0.0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::ranges::nth_element(values, middle);
  return *middle;
}

}  // namespace

CellNoise::CellNoise(const trace::LaunchArea& launch, const PassSums& map, std::uint32_t samples_per_cell)
    : launch_(launch), map_(map), samples_per_cell_(samples_per_cell) {
  if (launch.cells.empty()) return;
  const auto [west, east] = std::ranges::minmax(launch.cells, {}, &trace::LaunchCell::i);
  const auto [south, north] = std::ranges::minmax(launch.cells, {}, &trace::LaunchCell::j);
  first_ = {west.i, south.j};
  noise_ = Array2D<double>(column_of(east) + 1, row_of(north) + 1);
  is_cell_ = Array2D<std::uint8_t>(noise_.columns(), noise_.rows());
  for (const trace::LaunchCell& cell : launch.cells) is_cell_(column_of(cell), row_of(cell)) = 1;
}

std::size_t CellNoise::column_of(const trace::LaunchCell& cell) const {
  return static_cast<std::size_t>(cell.i - first_.i);
}

std::size_t CellNoise::row_of(const trace::LaunchCell& cell) const {
  return static_cast<std::size_t>(cell.j - first_.j);
}

void CellNoise::add(const trace::LaunchCell& cell, std::span<const radar::Echo> echoes) {
  for (const radar::Echo& echo : echoes) {
    const auto power = map_.mean_power_m2(echo);
    const auto rcs_m2 = static_cast<double>(echo.rcs_m2.power(radar::Polarization::Sum));
    if (!power || !(rcs_m2 > 0.0)) continue;
    const double relative = rcs_m2 / (*power + rcs_m2 / samples_per_cell_);
    noise_(column_of(cell), row_of(cell)) += relative * relative;
  }
}

double CellNoise::around(const trace::LaunchCell& cell) const {
  const std::size_t column = column_of(cell), row = row_of(cell);
  double sum = 0.0;
  int cells = 0;
  for (std::size_t j = row - std::min(row, neighbourhood); j < std::min(row + neighbourhood + 1, noise_.rows()); ++j) {
    for (std::size_t i = column - std::min(column, neighbourhood);
         i < std::min(column + neighbourhood + 1, noise_.columns()); ++i) {
      sum += noise_(i, j);
      cells += is_cell_(i, j);
    }
  }
  return sum / cells;
}

std::vector<LaunchShare> CellNoise::shares(std::uint32_t most) const {
  if (launch_.cells.empty()) return {{launch_, most}};
  std::vector<double> noise;
  for (const trace::LaunchCell& cell : launch_.cells) noise.push_back(around(cell));
  const double full = full_share * median_above_zero(noise);

  std::vector<LaunchShare> shares;
  for (std::uint32_t samples = most; samples > 0; samples /= 2) {
    shares.push_back({launch_, samples});
    shares.back().launch.cells.clear();
  }
  for (std::size_t cell = 0; cell < noise.size(); ++cell) {
    std::size_t share = 0;
    while (share + 1 < shares.size() && shares[share + 1].samples_per_cell * full >= noise[cell] * most) ++share;
    shares[share].launch.cells.push_back(launch_.cells[cell]);
  }
  std::erase_if(shares, [](const LaunchShare& share) { return share.launch.cells.empty(); });
  return shares;
}

}  // namespace sigmascape::simulate
