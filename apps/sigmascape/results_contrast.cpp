#include "results_contrast.h"

#include <fmt/format.h>

#include "results_columns.h"

namespace sigmascape::cli {

std::optional<MeasuredContrast> measured(const Contrast& contrast, const std::vector<ResultsRow>& rows) {
  const ResultsRow* with = find_row(rows, contrast.with);
  const ResultsRow* without = find_row(rows, contrast.without);
  if (with == nullptr || without == nullptr) return std::nullopt;
  const MeasuredContrast both{with, without, with->at_cell(summary_cell_m), without->at_cell(summary_cell_m)};
  if (both.with_cell == nullptr || both.without_cell == nullptr) return std::nullopt;
  return both;
}

std::string truth_line(const ResultsPlan& plan, const std::vector<ResultsRow>& rows, ViewKind kind,
                       const char* empty_cells) {
  const ResultsRow* row = baseline_row(plan, rows, plan.scene_name(), kind);
  const ResultsCell* cell = row != nullptr ? row->at_cell(summary_cell_m) : nullptr;
  if (cell == nullptr) return {};
  return fmt::format("| *truth* | one traced map against another | {} |{}\n", error_text(cell->floor_median),
                     empty_cells);
}

}  // namespace sigmascape::cli
