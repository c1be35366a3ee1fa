#include "results/contrast.h"

#include <fmt/format.h>

#include "results/columns.h"

namespace sigmascape::cli {

std::optional<MeasuredContrast> measured(const Contrast& contrast, const std::vector<ResultsRow>& rows) {
  const ResultsRow* with = find_row(rows, contrast.with);
  const ResultsRow* without = find_row(rows, contrast.without);
  const MeasuredContrast both{with, without, summary_cell(with), summary_cell(without)};
  if (both.with_cell == nullptr || both.without_cell == nullptr) return std::nullopt;
  return both;
}

std::string truth_line(const ResultsPlan& plan, const std::vector<ResultsRow>& rows, ViewKind kind,
                       const char* empty_cells) {
  const product::CellComparison* floor = noise_floor(plan, rows, plan.scene_name(), kind);
  if (floor == nullptr) return {};
  return fmt::format("| *truth* | one traced map against another | {} |{}\n", error_text(*floor), empty_cells);
}

}  // namespace sigmascape::cli
