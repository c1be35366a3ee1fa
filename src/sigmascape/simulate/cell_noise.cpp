#include "sigmascape/simulate/cell_noise.h"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "sigmascape/base/array2d.h"

namespace sigmascape::simulate {
namespace {

constexpr std::size_t neighbourhood = 2;

/// Noise over that of the median cell from which on a cell gets all rays.
constexpr double full_share = 0.5;

/// Where the radar sees nothing of the area directly one in so many cells gets a ray at least.
constexpr std::uint32_t rarest = 4;

/// The median of what is above zero; zero where nothing is.
double median_above_zero(std::vector<double> values) {
  std::erase_if(values, [](double value) { return !(value > 0.0); });
  if (values.empty()) return 0.0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::ranges::nth_element(values, middle);
  return *middle;
}

}  // namespace

CellNoise::CellNoise(const trace::LaunchArea& launch, const PassSums& sums, std::uint32_t samples_per_cell,
                     unsigned workers)
    : launch_(launch), sums_(sums), samples_per_cell_(samples_per_cell), brought_(workers) {
  if (launch.cells.empty()) return;
  const auto [west, east] = std::ranges::minmax(launch.cells, {}, &trace::LaunchCell::i);
  const auto [south, north] = std::ranges::minmax(launch.cells, {}, &trace::LaunchCell::j);
  first_ = {west.i, south.j};
  columns_ = column_of(east) + 1;
  rows_ = row_of(north) + 1;
}

std::size_t CellNoise::column_of(const trace::LaunchCell& cell) const {
  return static_cast<std::size_t>(cell.i - first_.i);
}

std::size_t CellNoise::row_of(const trace::LaunchCell& cell) const {
  return static_cast<std::size_t>(cell.j - first_.j);
}

void CellNoise::add(const trace::LaunchCell& cell, std::span<const radar::Echo> echoes, unsigned worker) {
  for (const radar::Echo& echo : echoes) {
    if (const auto bin = sums_.bin_in_area(echo)) {
      brought_[worker].push_back({.cell = cell,
                                  .bin = static_cast<std::uint32_t>(*bin),
                                  .rcs_m2 = echo.rcs_m2.power(radar::Polarization::Sum),
                                  .direct = echo.bounces == 1});
    }
  }
}

std::vector<CellNoise::Around> CellNoise::around_cells() const {
  Array2D<double> noise(columns_, rows_);
  Array2D<std::uint8_t> is_cell(columns_, rows_), is_seen(columns_, rows_);
  for (const trace::LaunchCell& cell : launch_.cells) is_cell(column_of(cell), row_of(cell)) = 1;
  for (const auto& of_worker : brought_) {
    for (const Brought& echo : of_worker) {
      const double power_m2 = sums_.mean_power_m2(echo.bin);
      if (!(power_m2 > 0.0)) continue;
      const double relative = static_cast<double>(echo.rcs_m2) / power_m2;
      const std::size_t column = column_of(echo.cell), row = row_of(echo.cell);
      noise(column, row) += relative * relative / (samples_per_cell_ * static_cast<double>(echo.cell.share));
      if (echo.direct) is_seen(column, row) = 1;
    }
  }
  std::vector<Around> around;
  for (const trace::LaunchCell& cell : launch_.cells) {
    const std::size_t column = column_of(cell), row = row_of(cell);
    Around sum;
    int cells = 0;
    for (std::size_t j = row - std::min(row, neighbourhood); j < std::min(row + neighbourhood + 1, rows_); ++j) {
      for (std::size_t i = column - std::min(column, neighbourhood); i < std::min(column + neighbourhood + 1, columns_);
           ++i) {
        sum.noise += noise(i, j);
        sum.is_seen = sum.is_seen || is_seen(i, j) != 0;
        cells += is_cell(i, j);
      }
    }
    sum.noise /= cells;
    around.push_back(sum);
  }
  return around;
}

std::vector<LaunchShare> CellNoise::shares(std::uint32_t most) const {
  if (launch_.cells.empty()) return {};
  const std::vector<Around> around = around_cells();
  std::vector<double> noise;
  for (const Around& cell : around) noise.push_back(cell.noise);
  const double full = full_share * median_above_zero(std::move(noise));

  std::vector<LaunchShare> shares;
  for (std::uint32_t samples = most; samples > 0; samples /= 2) shares.push_back({{}, samples, 1});
  for (std::uint32_t one_in = 2; one_in <= rarest; one_in *= 2) shares.push_back({{}, 1, one_in});
  for (std::size_t cell = 0; cell < around.size(); ++cell) {
    const double least = around[cell].is_seen ? 1.0 : 1.0 / rarest;
    const auto enough = [&](const LaunchShare& share) {
      const double rays = static_cast<double>(launch_.cells[cell].share) * share.samples_per_cell / share.one_in;
      return rays >= least && rays * full >= around[cell].noise * most;
    };
    std::size_t share = 0;
    while (share + 1 < shares.size() && enough(shares[share + 1])) ++share;
    shares[share].cells.push_back(launch_.cells[cell]);
  }
  std::erase_if(shares, [](const LaunchShare& share) { return share.cells.empty(); });
  return shares;
}

}  // namespace sigmascape::simulate
