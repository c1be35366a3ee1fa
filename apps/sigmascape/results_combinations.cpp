#include "results_combinations.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>

namespace sigmascape::cli {
namespace {

std::string name_of(const ResultsRow& row) {
  return fmt::format("{}{}{}, {}", text_of(row.of.method), row.of.change.empty() ? "" : ", ", row.of.change,
                     row.of.grid);
}

std::string metrics(const product::CellComparison& cell) {
  return fmt::format("{:.3f} | {:.2f} | {:+.2f} | {:.3f} | {:.2f}", cell.correlation_db, cell.rms_db, cell.bias_db,
                     cell.l1, cell.shadow_iou);
}

std::string line_of(const std::string& what, const ResultsRow& row) {
  return fmt::format("| {} | {} | {} | {:.2f} | {:.0f} | {:.0f} |\n", what, name_of(row),
                     metrics(row.at_cell(summary_cell_m)->median), static_cast<double>(row.atlas.store_bytes) / 1e6,
                     row.atlas.bake_seconds, row.render_ms);
}

/// What limits a way, in words; empty where its method has no looks of the views' own.
std::string limit_of(const ResultsRow& row, const std::vector<ResultsRow>& rows) {
  ResultsCase own = row.of;
  own.grid = own_look;
  own.change = "";
  const ResultsRow* own_row = find_row(rows, own);
  const ResultsCell* own_cell = own_row != nullptr ? own_row->at_cell(summary_cell_m) : nullptr;
  if (own_cell == nullptr) return {};
  const ResultsCell& cell = *row.at_cell(summary_cell_m);
  const ErrorParts parts = error_parts(cell.median.rms_db, own_cell->median.rms_db, cell.floor_median.rms_db);
  struct Part {
    const char* name;
    double db2;
  };
  const Part list[] = {{"missing angles", parts.missing_angles_db2},
                       {"the truth's own noise", parts.truth_noise_db2},
                       {"what stays at the view's own look: the bake's noise, its texels and mips", parts.rest_db2}};
  const auto percent = [&](double db2) { return 100.0 * db2 / parts.all_db2; };
  return fmt::format(
      "What limits *{}* most is {}. Its RMS error is {:.2f} dB, that of the view's own look, where no angle is "
      "missing, {:.2f} dB; two traced maps differ by {:.2f} dB, of which half is in their mean. Of the squared error "
      "missing angles are {:.0f} %, the truth's noise {:.0f} %, the rest {:.0f} %, roughly, for these are medians.\n\n",
      name_of(row), std::ranges::max_element(list, {}, &Part::db2)->name, cell.median.rms_db, own_cell->median.rms_db,
      cell.floor_median.rms_db, percent(parts.missing_angles_db2), percent(parts.truth_noise_db2),
      percent(parts.rest_db2));
}

}  // namespace

const ResultsRow* best_combination(const ResultsPlan& plan, const std::vector<ResultsRow>& rows,
                                   std::uintmax_t most_bytes) {
  const ResultsRow* best = nullptr;
  for (const ResultsRow& row : rows) {
    const ResultsCase& of = row.of;
    const bool is_way = of.scene == plan.scene_name() && of.kind == ViewKind::HeldOut && of.level_of_detail == 1 &&
                        of.grid != own_look && of.baked_samples == plan.baked_samples &&
                        of.change != renormalized_change;
    const ResultsCell* cell = row.at_cell(summary_cell_m);
    if (!is_way || cell == nullptr || std::isnan(cell->median.rms_db) || row.atlas.store_bytes > most_bytes) continue;
    if (best == nullptr || cell->median.rms_db < best->at_cell(summary_cell_m)->median.rms_db) best = &row;
  }
  return best;
}

ErrorParts error_parts(double rms_db, double own_look_rms_db, double traced_rms_db) {
  ErrorParts parts{.all_db2 = rms_db * rms_db};
  // Blending looks also averages their noise, so that a fine grid may come out better than the view's own look.
  const double without_missing_db2 = std::min(parts.all_db2, own_look_rms_db * own_look_rms_db);
  parts.missing_angles_db2 = parts.all_db2 - without_missing_db2;
  // The difference of two alike has twice the variance of each, their mean half.
  parts.truth_noise_db2 = std::min(without_missing_db2, traced_rms_db * traced_rms_db / 4.0);
  parts.rest_db2 = without_missing_db2 - parts.truth_noise_db2;
  return parts;
}

std::string combinations_section(const ResultsPlan& plan, const std::vector<ResultsRow>& rows) {
  const ResultsRow* paper = baseline_row(plan, rows, plan.scene_name(), ViewKind::HeldOut);
  const ResultsCell* cell = paper != nullptr ? paper->at_cell(summary_cell_m) : nullptr;
  if (cell == nullptr) return {};
  const ResultsRow* small = best_combination(plan, rows, paper->atlas.store_bytes);
  const ResultsRow* best = best_combination(plan, rows, std::numeric_limits<std::uintmax_t>::max());
  std::string text =
      "### The best of them together\n\nThe paper's method at held-out views, and the combinations of the changes "
      "above "
      "that have the least RMS error: in no more bytes than the paper's, and in any.\n\n"
      "| | method | correlation of dB | RMS [dB] | bias [dB] | relative L1 | shadow IoU | store [MB] | bake [s] | "
      "frame [ms] |\n|---|---|---:|---:|---:|---:|---:|---:|---:|---:|\n";
  text += fmt::format("| *truth* | one traced map against another | {} | | | |\n", metrics(cell->floor_median));
  text += line_of("paper", *paper);
  if (small != nullptr) text += line_of(small == best ? "best in its bytes and of all" : "best in its bytes", *small);
  if (best != nullptr && best != small) text += line_of("best of all", *best);
  text += "\n";
  if (small != nullptr) text += limit_of(*small, rows);
  if (best != nullptr && best != small) text += limit_of(*best, rows);
  return text;
}

}  // namespace sigmascape::cli
