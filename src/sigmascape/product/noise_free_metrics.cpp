#include "sigmascape/product/noise_free_metrics.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <vector>

#include "sigmascape/base/error.h"
#include "sigmascape/base/units.h"
#include "sigmascape/product/block_mean.h"
#include "sigmascape/product/same_cells.h"

namespace sigmascape::product {
namespace {

/// The dB of both tested maps, then of both truths.
using Fourfold = std::array<double, 4>;

std::vector<Fourfold> cells_seen_by_all(const RepeatedMap& tested, const RepeatedMap& truth, double cell_m,
                                        const CompareOptions& options) {
  const std::array maps{&tested.first, &tested.second, &truth.first, &truth.second};
  for (const radar::GroundMap* map : maps) require_same_cells(*map, truth.first);
  const std::size_t factor = required_block_factor(cell_m, truth.first.grid);
  std::array<Array2D<double>, 4> blocks;
  for (std::size_t i = 0; i < maps.size(); ++i) blocks[i] = block_mean(*maps[i], options.polarization, factor);

  const double floor = linear_from_db(options.floor_db);
  std::vector<Fourfold> cells;
  for (std::size_t place = 0; place < blocks.front().size(); ++place) {
    Fourfold powers;
    for (std::size_t i = 0; i < powers.size(); ++i) powers[i] = blocks[i].values()[place];
    if (std::ranges::any_of(powers, [](double power) { return std::isnan(power); })) continue;
    for (double& value : powers) value = db_from_linear(std::max(value, floor));
    cells.push_back(powers);
  }
  if (cells.empty()) {
    throw Error("maps to compare", fmt::format("no cell of {:g} m was seen wholly by all four", cell_m),
                "compare maps of the same ground, or at smaller cells");
  }
  return cells;
}

/// Mean over the cells of (value i − shift i) (value j − shift j).
double mean_product(const std::vector<Fourfold>& cells, const Fourfold& shift, std::size_t i, std::size_t j) {
  double sum = 0.0;
  for (const Fourfold& cell : cells) sum += (cell[i] - shift[i]) * (cell[j] - shift[j]);
  return sum / static_cast<double>(cells.size());
}

double mean_square(const std::vector<Fourfold>& cells, std::size_t i, std::size_t j) {
  double sum = 0.0;
  for (const Fourfold& cell : cells) sum += (cell[i] - cell[j]) * (cell[i] - cell[j]);
  return sum / static_cast<double>(cells.size());
}

Fourfold means_of(const std::vector<Fourfold>& cells) {
  Fourfold means{};
  for (const Fourfold& cell : cells) {
    for (std::size_t i = 0; i < means.size(); ++i) means[i] += cell[i] / static_cast<double>(cells.size());
  }
  return means;
}

}  // namespace

NoiseFreeComparison compare_without_noise(const RepeatedMap& tested, const RepeatedMap& truth, double cell_m,
                                          const CompareOptions& options) {
  const std::vector<Fourfold> cells = cells_seen_by_all(tested, truth, cell_m, options);
  const Fourfold means = means_of(cells);
  double shared = 0.0, apart = 0.0;
  for (const std::size_t test : {0U, 1U}) {
    for (const std::size_t true_map : {2U, 3U}) {
      shared += mean_product(cells, means, test, true_map) / 4.0;
      apart += mean_square(cells, test, true_map) / 4.0;
    }
  }
  const double of_tested = mean_product(cells, means, 0, 1), of_truth = mean_product(cells, means, 2, 3);
  const double noise = (mean_square(cells, 0, 1) + mean_square(cells, 2, 3)) / 2.0;
  return {.cell_m = cell_m,
          .cells = cells.size(),
          .correlation_db = of_tested > 0.0 && of_truth > 0.0 ? shared / std::sqrt(of_tested * of_truth)
                                                              : std::numeric_limits<double>::quiet_NaN(),
          .rms_db = std::sqrt(std::max(0.0, apart - noise))};
}

}  // namespace sigmascape::product
