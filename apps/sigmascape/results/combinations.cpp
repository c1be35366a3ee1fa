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

constexpr const char* way_heads =
    "| | method | correlation of dB | RMS [dB] | bias [dB] | relative L1 | shadow IoU | store [MB] | bake [s] | map "
    "[s] "
    "|\n|---|---|---:|---:|---:|---:|---:|---:|---:|---:|\n";

std::string line_of(const std::string& what, const ResultsRow& row) {
  return fmt::format("| {} | {} | {} | {} | {:.0f} | {:.2f} |\n", what, name_of(row),
                     metrics_text(row.at_cell(summary_cell_m)->median), megabytes(row.atlas.store_bytes),
                     row.atlas.bake_seconds, row.render_ms / 1e3);
}

/// A way beside the look that is each view's own, where no angle is missing.
struct WithOwnLook {
  const ResultsCell *way, *own;

  [[nodiscard]] ErrorParts parts() const {
    return error_parts(way->median.rms_db, own->median.rms_db, way->floor_median.rms_db);
  }
  [[nodiscard]] bool way_is_closer() const { return way->median.rms_db <= own->median.rms_db; }
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
  const product::CellComparison &way = both->way->median, &own = both->own->median;
  const std::string by_l1 = fmt::format(
      "By relative L1, for which faint cells count little, it is {} with the angles of the grid missing and {} from "
      "the "
      "own look.\n\n",
      number_text(way.l1, 3), number_text(own.l1, 3));
  if (both->way_is_closer()) {
    return fmt::format(
               "*{}* comes closer than the view's own look from as many rays, {:.2f} against {:.2f} dB RMS: it blends "
               "several looks, whose noise averages. So what limits it most is {}; how much of it missing angles are, "
               "RMS does not tell. ",
               name_of(row), way.rms_db, own.rms_db, largest_limit(row, rows)->name) +
           by_l1;
  }
  const ErrorParts parts = both->parts();
  const auto percent = [&](double db2) { return 100.0 * db2 / parts.all_db2; };
  return fmt::format(
             "What limits *{}* most is {}. Its RMS error is {:.2f} dB, that of the view's own look, where no angle is "
             "missing, {:.2f} dB; two traced maps differ by {:.2f} dB, of which half is in their mean. Of the squared "
             "error missing angles are {:.0f} %, the truth's noise {:.0f} %, the rest {:.0f} %, roughly, for these are "
             "medians, and several blended looks have less noise than an own one. ",
             name_of(row), largest_limit(row, rows)->name, way.rms_db, own.rms_db, both->way->floor_median.rms_db,
             percent(parts.missing_angles_db2), percent(parts.truth_noise_db2), percent(parts.rest_db2)) +
         by_l1;
}

/// The ways that are told of first: the paper's, ours from the same looks, the best in the paper's bytes, the best of
/// all, and the paper's from the looks of that.
struct Best {
  const ResultsRow *paper, *alike, *in_its_bytes, *of_all, *paper_alike;
};

/// The same with another method.
const ResultsRow* by(Method method, const ResultsRow& row, const std::vector<ResultsRow>& rows) {
  ResultsCase of = row.of;
  of.method = method;
  of.change = "";
  const ResultsRow* found = find_row(rows, of);
  return summary_cell(found) != nullptr ? found : nullptr;
}

std::optional<Best> best_of(const ResultsPlan& plan, const std::vector<ResultsRow>& rows) {
  const ResultsRow* paper = baseline_row(plan, rows, plan.scene_name(), ViewKind::HeldOut);
  if (summary_cell(paper) == nullptr) return std::nullopt;
  const ResultsRow* of_all = best_combination(plan, rows, std::numeric_limits<std::uintmax_t>::max());
  return Best{paper, by(Method::OwnGround, *paper, rows), best_combination(plan, rows, paper->atlas.store_bytes),
              of_all, of_all != nullptr ? by(Method::Paper, *of_all, rows) : nullptr};
}

/// "3.32 dB RMS and a correlation of 0.949".
std::string closeness(const product::CellComparison& cell) {
  return fmt::format("{} dB RMS and a correlation of {}", number_text(cell.rms_db, 2),
                     number_text(cell.correlation_db, 3));
}

/// The same ways at views that were baked; empty without such views.
std::string verdict_on_grid(const std::vector<ResultsRow>& rows, const ResultsRow& best) {
  ResultsCase of = best.of;
  of.kind = ViewKind::OnGrid;
  const ResultsRow* row = find_row(rows, of);
  if (summary_cell(row) == nullptr) return {};
  const ResultsRow* paper = by(Method::Paper, *row, rows);
  if (paper == nullptr) return {};
  return fmt::format("At the {} views that were baked they come to {}, the paper's from as many looks to {}. ",
                     row->views, closeness(summary_cell(row)->median), closeness(summary_cell(paper)->median));
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
  constexpr const char* noise = "the bake's noise, with its texels and mips";
  if (both->way_is_closer()) return Limit{noise, std::nullopt};
  const ErrorParts parts = both->parts();
  struct Part {
    const char* name;
    double db2;
  };
  const Part list[] = {{"missing angles", parts.missing_angles_db2},
                       {"the truth's own noise", parts.truth_noise_db2},
                       {noise, parts.rest_db2}};
  const Part& most = *std::ranges::max_element(list, {}, &Part::db2);
  return Limit{most.name, most.db2 / parts.all_db2};
}

std::string combinations_table(const ResultsPlan& plan, const std::vector<ResultsRow>& rows) {
  const auto best = best_of(plan, rows);
  if (!best) return {};
  struct Line {
    const char* what;
    const ResultsRow* row;
  };
  const Line lines[] = {{"paper", best->paper},
                        {"ours, the same looks", best->alike},
                        {"best in the paper's bytes", best->in_its_bytes},
                        {"best of all", best->of_all},
                        {"paper, the looks of the best", best->paper_alike}};
  std::string text =
      way_heads + fmt::format("| *truth* | one traced map against another, {} rays a cell | {} | | | {:.2f} |\n",
                              best->paper->rays.text(),
                              metrics_text(best->paper->at_cell(summary_cell_m)->floor_median),
                              best->paper->trace_seconds);
  std::vector<const ResultsRow*> told;
  for (const auto& [what, row] : lines) {
    if (row == nullptr || std::ranges::find(told, row) != told.end()) continue;
    told.push_back(row);
    std::string words = what;
    for (const auto& [other, same] : lines) {
      if (same == row && other != what) words += std::string("; ") + other;
    }
    text += line_of(words, *row);
  }
  return text + "\n";
}

std::string limits_section(const ResultsPlan& plan, const std::vector<ResultsRow>& rows) {
  const auto best = best_of(plan, rows);
  if (!best) return {};
  std::string text;
  if (best->in_its_bytes != nullptr) text += limit_of(*best->in_its_bytes, rows);
  if (best->of_all != nullptr && best->of_all != best->in_its_bytes) text += limit_of(*best->of_all, rows);
  return text.empty() ? text : "### What limits the best of them\n\n" + text;
}

std::string verdict(const ResultsPlan& plan, const std::vector<ResultsRow>& rows) {
  const auto best = best_of(plan, rows);
  if (!best || best->of_all == nullptr) return {};
  const ResultsRow &paper = *best->paper, &of_all = *best->of_all;
  const ResultsCell &cell = *of_all.at_cell(summary_cell_m), &paper_cell = *paper.at_cell(summary_cell_m);
  std::string text;
  if (best->alike != nullptr) {
    text += fmt::format(
        "From the paper's {} looks our maps of {} views that were not baked come to {} at {:.0f} m cells in {} MB, the "
        "paper's method to {} in {} MB. ",
        paper.of.grid, paper.views, closeness(summary_cell(best->alike)->median), summary_cell_m,
        megabytes(best->alike->atlas.store_bytes), closeness(paper_cell.median), megabytes(paper.atlas.store_bytes));
  }
  text += fmt::format(
      "A map is made from its textures in {:.2f} s of processor time; traced from the scene with {} rays a cell it "
      "takes {:.0f} s. The best maps, *{}*, come to {} in {} MB",
      of_all.render_ms / 1e3, of_all.rays.fewest, of_all.trace_seconds, name_of(of_all), closeness(cell.median),
      megabytes(of_all.atlas.store_bytes));
  if (best->paper_alike != nullptr && best->paper_alike != best->of_all) {
    text += fmt::format(", the paper's method from as many looks to {} in {} MB",
                        closeness(summary_cell(best->paper_alike)->median),
                        megabytes(best->paper_alike->atlas.store_bytes));
  }
  text += ". " + verdict_on_grid(rows, of_all);
  text += fmt::format(
      "Two traced maps of a held-out view differ by {} dB, so that no map could be shown to come closer than {} dB",
      number_text(cell.floor_median.rms_db, 2), number_text(least_error(cell.floor_median.rms_db), 2));
  if (const auto limit = largest_limit(of_all, rows)) {
    text += "; what limits the best most";
    if (limit->share) text += fmt::format(", with about {:.0f} % of its squared error,", 100.0 * *limit->share);
    text += " is " + limit->name;
  }
  return text + ".\n\n";
}

}  // namespace sigmascape::cli
