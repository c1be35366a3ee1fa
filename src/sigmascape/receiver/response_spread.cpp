#include "sigmascape/receiver/response_spread.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "sigmascape/base/vector_targets.h"
#include "sigmascape/receiver/bin_response.h"

namespace sigmascape::receiver {
namespace {

using Bins = Array2D<radar::Channels>;

/// Images of a few targets are dark nearly everywhere.
bool is_dark(std::span<const radar::Channels> row) {
  return std::ranges::all_of(row, [](const radar::Channels& bin) { return bin == radar::Channels{}; });
}

/// Adds as many bins from elsewhere, each times the weight.
SIGMASCAPE_VECTOR_TARGETS [[gnu::flatten]] void add_weighted(const radar::Channels* __restrict from, float weight,
                                                             std::span<radar::Channels> to) {
  radar::Channels* const sums = to.data();
  SIGMASCAPE_INDEPENDENT_TURNS
  for (std::size_t i = 0; i < to.size(); ++i) sums[i] += from[i] * weight;
}

/// Every bin spreads over its neighbours in its row. What leaves the row is lost, as it is to a receiver's gate, or
/// where the row goes round comes in at the other end. Bins are many, and memory for another image of them would cost
/// more than the sums do: here and below only what is overwritten before its turn is kept elsewhere.
void spread_along_rows(Bins& bins, const std::vector<float>& weights, bool goes_round) {
  const std::size_t whole = weights.size() / 2, columns = bins.columns();
  // Beyond the other end of a row that does not go round there is nothing to come from.
  const std::size_t reach = goes_round ? whole : std::min(whole, std::max<std::size_t>(columns, 1) - 1);
  // The row, and what lies beyond its ends as far as a bin spreads.
  std::vector<radar::Channels> from(columns + 2 * reach);
  for (std::size_t row = 0; row < bins.rows(); ++row) {
    const auto to = bins.row(row);
    if (is_dark(to)) continue;
    std::ranges::copy(to, from.begin() + static_cast<std::ptrdiff_t>(reach));
    for (std::size_t beyond = 0; goes_round && beyond < reach; ++beyond) {
      from[reach - 1 - beyond] = to[columns - 1 - beyond % columns];
      from[reach + columns + beyond] = to[beyond % columns];
    }
    std::ranges::fill(to, radar::Channels{});
    for (std::size_t k = 0; k <= 2 * reach; ++k) add_weighted(from.data() + k, weights[whole - reach + k], to);
  }
}

/// The same in columns.
void spread_along_columns(Bins& bins, const std::vector<float>& weights) {
  const auto reach = static_cast<std::ptrdiff_t>(weights.size() / 2), rows = static_cast<std::ptrdiff_t>(bins.rows());
  // Of the row in hand and those before it, as they were.
  Bins kept(bins.columns(), static_cast<std::size_t>(reach) + 1);
  std::vector<std::uint8_t> dark(bins.rows());
  for (std::size_t row = 0; row < bins.rows(); ++row) dark[row] = is_dark(bins.row(row)) ? 1 : 0;
  const auto kept_row = [&kept](std::ptrdiff_t row) { return kept.row(static_cast<std::size_t>(row) % kept.rows()); };
  for (std::ptrdiff_t row = 0; row < rows; ++row) {
    const auto to = bins.row(static_cast<std::size_t>(row));
    std::ranges::copy(to, kept_row(row).begin());
    if (dark[static_cast<std::size_t>(row)] == 0) std::ranges::fill(to, radar::Channels{});
    for (std::ptrdiff_t k = std::max(-reach, -row); k <= std::min(reach, rows - 1 - row); ++k) {
      if (dark[static_cast<std::size_t>(row + k)] != 0) continue;
      const float weight = weights[static_cast<std::size_t>(k + reach)];
      const auto from = k <= 0 ? kept_row(row + k) : bins.row(static_cast<std::size_t>(row + k));
      add_weighted(from.data(), weight, to);
    }
  }
}

}  // namespace

void spread_responses(radar::RangeAzimuthImage& image, const radar::Radar& radar) {
  const radar::RangeAzimuthGrid& grid = image.grid;
  spread_along_rows(image.rcs_m2, azimuth_response(radar, grid.azimuth_step_rad).weights, grid.goes_round());
  spread_along_columns(image.rcs_m2, range_response(radar, grid.range_step_m).weights);
}

}  // namespace sigmascape::receiver
