#include "results/combinations.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>

#include "results/columns.h"

namespace sigmascape::cli {
namespace {

std::string name_of(const ResultsRow& row) {
  return fmt::format("{}{}{}, {}", text_of(row.of.method), row.of.change.empty() ? "" : ", ", row.of.change,
                     row.of.grid);
}

std::string line_of(const std::string& what, const ResultsRow& row) {
  return fmt::format("| {} | {} | {} | {} | {:.0f} | {:.0f} |\n", what, name_of(row),
                     metrics_text(row.at_cell(summary_cell_m)->median), megabytes(row.atlas.store_bytes),
                     row.atlas.bake_seconds, row.render_ms);
}

/// A way beside the look that is each view's own, where no angle is missing.
struct WithOwnLook {
  const ResultsCell *way, *own;

  [[nodiscard]] ErrorParts parts() const {
    return error_parts(way->median.rms_db, own->median.rms_db, way->floor_median.rms_db);
  }
};

std::optional<WithOwnLook> with_own_look(const ResultsRow& row, const std::vector<ResultsRow>& rows) {
  ResultsCase own = row.of;
  own.grid = own_look;
  own.change = "";
  const ResultsCell* own_cell = summary_cell(find_row(rows, own));
  if (own_cell == nullptr) return std::nullopt;
  return WithOwnLook{row.at_cell(summary_cell_m), own_cell};
}

/// What limits a way, in words; empty where its method has no looks of the views' own.
std::string limit_of(const ResultsRow& row, const std::vector<ResultsRow>& rows) {
  const auto both = with_own_look(row, rows);
  if (!both) return {};
  const ErrorParts parts = both->parts();
  const auto percent = [&](double db2) { return 100.0 * db2 / parts.all_db2; };
  return fmt::format(
      "What limits *{}* most is {}. Its RMS error is {:.2f} dB, that of the view's own look, where no angle is "
      "missing, {:.2f} dB; two traced maps differ by {:.2f} dB, of which half is in their mean. Of the squared error "
      "missing angles are {:.0f} %, the truth's noise {:.0f} %, the rest {:.0f} %, roughly, for these are medians.\n\n",
      name_of(row), largest_limit(row, rows)->name, both->way->median.rms_db, both->own->median.rms_db,
      both->way->floor_median.rms_db, percent(parts.missing_angles_db2), percent(parts.truth_noise_db2),
      percent(parts.rest_db2));
}

struct Best {
  const ResultsRow *paper, *in_its_bytes, *of_all;
};

std::optional<Best> best_of(const ResultsPlan& plan, const std::vector<ResultsRow>& rows) {
  const ResultsRow* paper = baseline_row(plan, rows, plan.scene_name(), ViewKind::HeldOut);
  if (summary_cell(paper) == nullptr) return std::nullopt;
  return Best{paper, best_combination(plan, rows, paper->atlas.store_bytes),
              best_combination(plan, rows, std::numeric_limits<std::uintmax_t>::max())};
}

/// "3.32 dB RMS and a correlation of 0.949".
std::string closeness(const product::CellComparison& cell) {
  return fmt::format("{} dB RMS and a correlation of {}", number_text(cell.rms_db, 2),
                     number_text(cell.correlation_db, 3));
}

/// The same ways at views that were baked; empty without such views.
std::string verdict_on_grid(const ResultsPlan& plan, const std::vector<ResultsRow>& rows, const ResultsRow& best) {
  ResultsCase of = best.of;
  of.kind = ViewKind::OnGrid;
  const ResultsRow* row = find_row(rows, of);
  const ResultsCell* cell = summary_cell(row);
  const ResultsCell* paper_cell = summary_cell(baseline_row(plan, rows, plan.scene_name(), ViewKind::OnGrid));
  if (cell == nullptr || paper_cell == nullptr) return {};
  return fmt::format("At the {} views that were baked they come to {}, the paper's to {}. ", row->views,
                     closeness(cell->median), closeness(paper_cell->median));
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
  parts.truth_noise_db2 = std::min(without_missing_db2, std::pow(least_error(traced_rms_db), 2.0));
  parts.rest_db2 = without_missing_db2 - parts.truth_noise_db2;
  return parts;
}

double most_correlation(double traced_correlation) {
  return std::sqrt(2.0 * traced_correlation / (1.0 + traced_correlation));
}

std::optional<Limit> largest_limit(const ResultsRow& row, const std::vector<ResultsRow>& rows) {
  const auto both = with_own_look(row, rows);
  if (!both) return std::nullopt;
  const ErrorParts parts = both->parts();
  struct Part {
    const char* name;
    double db2;
  };
  const Part list[] = {{"missing angles", parts.missing_angles_db2},
                       {"the truth's own noise", parts.truth_noise_db2},
                       {"what stays at the view's own look: the bake's noise, its texels and mips", parts.rest_db2}};
  const Part& most = *std::ranges::max_element(list, {}, &Part::db2);
  return Limit{most.name, most.db2 / parts.all_db2};
}

std::string combinations_table(const ResultsPlan& plan, const std::vector<ResultsRow>& rows) {
  const auto best = best_of(plan, rows);
  if (!best) return {};
  const auto& [paper, in_its_bytes, of_all] = *best;
  std::string text =
      "| | method | correlation of dB | RMS [dB] | bias [dB] | relative L1 | shadow IoU | store [MB] | bake [s] | "
      "frame [ms] |\n|---|---|---:|---:|---:|---:|---:|---:|---:|---:|\n";
  text += fmt::format("| *truth* | one traced map against another | {} | | | |\n",
                      metrics_text(paper->at_cell(summary_cell_m)->floor_median));
  text += line_of("paper", *paper);
  if (in_its_bytes != nullptr)
    text += line_of(in_its_bytes == of_all ? "best in the paper's bytes, and of all" : "best in the paper's bytes",
                    *in_its_bytes);
  if (of_all != nullptr && of_all != in_its_bytes) text += line_of("best of all", *of_all);
  return text + "\n";
}

std::string limits_section(const ResultsPlan& plan, const std::vector<ResultsRow>& rows) {
  const auto best = best_of(plan, rows);
  if (!best) return {};
  const auto& [paper, in_its_bytes, of_all] = *best;
  std::string text;
  if (in_its_bytes != nullptr) text += limit_of(*in_its_bytes, rows);
  if (of_all != nullptr && of_all != in_its_bytes) text += limit_of(*of_all, rows);
  return text.empty() ? text : "### What limits the best of them\n\n" + text;
}

std::string verdict(const ResultsPlan& plan, const std::vector<ResultsRow>& rows) {
  const auto best = best_of(plan, rows);
  if (!best || best->of_all == nullptr) return {};
  const auto& [paper, in_its_bytes, of_all] = *best;
  const ResultsCell &cell = *of_all->at_cell(summary_cell_m), &paper_cell = *paper->at_cell(summary_cell_m);
  std::string text = fmt::format(
      "At the {} views that were not baked the best baked maps, *{}*, come to {} at {:.0f} m cells in {} MB; the "
      "paper's method, {}, comes to {} in {} MB. ",
      of_all->views, name_of(*of_all), closeness(cell.median), summary_cell_m, megabytes(of_all->atlas.store_bytes),
      paper->of.grid, closeness(paper_cell.median), megabytes(paper->atlas.store_bytes));
  text += verdict_on_grid(plan, rows, *of_all);
  text += fmt::format(
      "Two traced maps of a held-out view differ by {} dB, so that no map could be shown to come closer than {} dB",
      number_text(cell.floor_median.rms_db, 2), number_text(least_error(cell.floor_median.rms_db), 2));
  if (const auto limit = largest_limit(*of_all, rows)) {
    text += fmt::format("; what limits the best most, with about {:.0f} % of its squared error, is {}",
                        100.0 * limit->share, limit->name);
  }
  return text + ".\n\n";
}

}  // namespace sigmascape::cli
