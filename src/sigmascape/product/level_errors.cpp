#include "sigmascape/product/level_errors.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sigmascape/base/units.h"
#include "sigmascape/product/block_mean.h"
#include "sigmascape/product/same_cells.h"

namespace sigmascape::product {
namespace {

std::vector<LevelError> ranges_between(const std::vector<double>& bounds_db) {
  constexpr double endless = std::numeric_limits<double>::infinity();
  std::vector<LevelError> ranges{{.from_db = -endless, .to_db = endless}};
  for (const double bound_db : bounds_db) {
    ranges.back().to_db = bound_db;
    ranges.push_back({.from_db = bound_db, .to_db = endless});
  }
  return ranges;
}

}  // namespace

std::vector<LevelError> errors_by_level(const radar::GroundMap& tested, const radar::GroundMap& truth,
                                        const radar::GroundMap& level, const std::vector<double>& bounds_db,
                                        double cell_m, const CompareOptions& options) {
  require_same_cells(tested, truth);
  require_same_cells(level, truth);
  const std::size_t factor = required_block_factor(cell_m, truth.grid);
  const Array2D<double> a = block_mean(tested, options.polarization, factor);
  const Array2D<double> b = block_mean(truth, options.polarization, factor);
  const Array2D<double> levels = block_mean(level, options.polarization, factor);
  const double floor = linear_from_db(options.floor_db);
  const auto decibels = [&](double power) { return db_from_linear(std::max(power, floor)); };

  std::vector<LevelError> ranges = ranges_between(bounds_db);
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (std::isnan(a.values()[i]) || std::isnan(b.values()[i]) || std::isnan(levels.values()[i])) continue;
    const double error_db = decibels(a.values()[i]) - decibels(b.values()[i]);
    const auto above = std::ranges::upper_bound(bounds_db, decibels(levels.values()[i]));
    LevelError& range = ranges[static_cast<std::size_t>(above - bounds_db.begin())];
    ++range.cells;
    range.squared_error_db2 += error_db * error_db;
  }
  return ranges;
}

std::vector<LevelError> errors_by_level(const radar::GroundMap& tested, const radar::GroundMap& truth,
                                        const std::vector<double>& bounds_db, double cell_m,
                                        const CompareOptions& options) {
  return errors_by_level(tested, truth, truth, bounds_db, cell_m, options);
}

}  // namespace sigmascape::product
