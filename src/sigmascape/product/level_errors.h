#pragma once

#include <cstddef>
#include <vector>

#include "sigmascape/product/map_metrics.h"
#include "sigmascape/radar/ground_map.h"

namespace sigmascape::product {

/// The error in dB of the cells of one range of levels.
struct LevelError {
  double from_db = 0.0;  ///< −∞ for the lowest range
  double to_db = 0.0;    ///< +∞ for the highest, which does not hold it
  std::size_t cells = 0;
  double squared_error_db2 = 0.0;  ///< Σ (A − B)² of tested and true dB over the cells, CellComparison's
};

/// Splits the squared error in dB of a map by the truth's level, so that all entries together give cells · rms_db² of
/// compare_maps. `bounds_db`, rising, part the levels: n bounds make n + 1 ranges. Cells are those that both saw
/// wholly. Throws Error when grid or frame differ and when the cell is no multiple of the maps'.
[[nodiscard]] std::vector<LevelError> errors_by_level(const radar::GroundMap& tested, const radar::GroundMap& truth,
                                                      const std::vector<double>& bounds_db, double cell_m,
                                                      const CompareOptions& options = {});

/// The same with levels from a third map, where truth itself is too noisy to say which cells are faint.
[[nodiscard]] std::vector<LevelError> errors_by_level(const radar::GroundMap& tested, const radar::GroundMap& truth,
                                                      const radar::GroundMap& level,
                                                      const std::vector<double>& bounds_db, double cell_m,
                                                      const CompareOptions& options = {});

}  // namespace sigmascape::product
