#include "results/combinations.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <optional>

#include "results/columns.h"
#include "results/contrast.h"
#include "results/costs.h"
#include "words.h"

namespace sigmascape::cli {
namespace {

std::string name_of(const ResultsRow& row) {
  return fmt::format("{}, {}", way_text(row.of), row.of.grid);
}

constexpr const char* way_heads =
    "| | method, looks | correlation of dB | RMS [dB] | bias [dB] | relative L1 | shadow IoU | store [MB] | bake [s] | "
    "one map [s] |\n|---|---|---:|---:|---:|---:|---:|---:|---:|---:|\n";

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
  /// How much of the squared error missing angles are at least, where they are most of it; nothing where they may not
  /// be. No other part is named so: a way blends several looks, whose noise averages, and the own look has all of it.
  [[nodiscard]] std::optional<double> share_of_missing_angles() const {
    const ErrorParts of = parts();
    if (way_is_closer() || of.missing_angles_db2 < std::max(of.truth_noise_db2, of.rest_db2)) return std::nullopt;
    return of.missing_angles_db2 / of.all_db2;
  }
};

std::optional<WithOwnLook> with_own_look(const ResultsRow& row, const std::vector<ResultsRow>& rows) {
  ResultsCase own = row.of;
  own.grid = own_look;
  if (own.change != adaptive_change) own.change = "";
  const ResultsCell* own_cell = summary_cell(find_row(rows, own));
  if (own_cell == nullptr) return std::nullopt;
  return WithOwnLook{row.at_cell(summary_cell_m), own_cell};
}

/// What limits a way, in words; empty where its method has no looks of the views' own.
std::string limit_of(const ResultsRow& row, const std::vector<ResultsRow>& rows) {
  const auto both = with_own_look(row, rows);
  if (!both) return {};
  const product::CellComparison &way = both->way->median, &own = both->own->median;
  const std::string by_l1 =
      fmt::format("By relative L1, in which faint cells count little, its error is {}, that of the own look {}.\n\n",
                  number_text(way.l1, 3), number_text(own.l1, 3));
  if (both->way_is_closer()) {
    return fmt::format(
               "*{}* comes closer to the truth, {:.2f} dB RMS, than a texture baked for the view itself with as many "
               "rays (its own look), {:.2f} dB: it blends several looks, whose noise averages. How much of its error "
               "missing angles are, and how much noise, these numbers do not tell. ",
               name_of(row), way.rms_db, own.rms_db) +
           by_l1;
  }
  const ErrorParts parts = both->parts();
  const auto percent = [&](double db2) { return 100.0 * db2 / parts.all_db2; };
  const std::string cause = both->share_of_missing_angles()
                                ? fmt::format("What limits *{}* most is missing angles.", name_of(row))
                                : fmt::format("The error of *{}* has several causes.", name_of(row));
  return fmt::format(
             "{} Its RMS error is {:.2f} dB; from a texture baked for the view itself (its own look), where no angle "
             "is missing, {:.2f} dB are left; two traced maps differ by {:.2f} dB, and at least half of that is left "
             "in "
             "their mean. So of the squared error missing angles are at least {:.0f} %, the truth's noise at least "
             "{:.0f} %, and the bake's noise, texels and mips at most the remaining {:.0f} %: roughly, for these are "
             "medians, and "
             "blending looks averages noise that the own look has in full. ",
             cause, way.rms_db, own.rms_db, both->way->floor_median.rms_db, percent(parts.missing_angles_db2),
             percent(parts.truth_noise_db2), percent(parts.rest_db2)) +
         by_l1;
}

/// The ways that are told of first: the paper's, ours from the same looks, the best in the paper's bytes, the best of
/// all, and the paper's from the looks of that.
struct Best {
  const ResultsRow *paper, *alike, *in_its_bytes, *of_all, *paper_alike;
};

/// The same with another method, as the plan has it.
const ResultsRow* by(Method method, const ResultsRow& row, const ResultsPlan& plan,
                     const std::vector<ResultsRow>& rows) {
  ResultsCase of = row.of;
  of.method = method;
  of.baked_samples = plan.baked_samples;
  of.change = "";
  const ResultsRow* found = find_row(rows, of);
  return summary_cell(found) != nullptr ? found : nullptr;
}

std::optional<Best> best_of(const ResultsPlan& plan, const std::vector<ResultsRow>& rows) {
  const ResultsRow* paper = baseline_row(plan, rows, plan.scene_name(), ViewKind::HeldOut);
  if (summary_cell(paper) == nullptr) return std::nullopt;
  const ResultsRow* of_all = best_combination(plan, rows, std::numeric_limits<std::uintmax_t>::max());
  return Best{paper, by(Method::OwnGround, *paper, plan, rows), best_combination(plan, rows, paper->atlas.store_bytes),
              of_all, of_all != nullptr ? by(Method::Paper, *of_all, plan, rows) : nullptr};
}

/// "3.32 dB RMS (correlation 0.949, 12.75 MB of textures)".
std::string closeness(const ResultsRow& row) {
  const product::CellComparison& cell = summary_cell(&row)->median;
  return fmt::format("{} dB RMS (correlation {}, {} MB of textures)", number_text(cell.rms_db, 2),
                     number_text(cell.correlation_db, 3), megabytes(row.atlas.store_bytes));
}

std::string rms_text(const ResultsRow& row) {
  return number_text(summary_cell(&row)->median.rms_db, 2) + " dB";
}

/// How far both methods are from traced maps, from the paper's looks.
std::string found_from_the_papers_looks(const ResultsPlan& plan, const Best& best) {
  const LookGrid& looks = plan.paper_grid();
  const std::string baked_for = fmt::format("the paper's {} directions ({} azimuths at {} elevations each)",
                                            looks.name(), looks.azimuths, looks.elevations_deg.size());
  const std::string where = fmt::format("medians over {} from other directions, at {:.0f} m cells",
                                        counted(best.paper->views, "view", "views"), summary_cell_m);
  if (best.alike == nullptr) {
    return fmt::format(
        "Maps rendered by the paper's method from textures that were baked for {} differ from "
        "path-traced maps by {}: {}. ",
        baked_for, closeness(*best.paper), where);
  }
  return fmt::format(
      "Maps rendered from textures that were baked for {} differ from path-traced maps by {} with our method and by {} "
      "with the paper's: {}. Ours come closer at {} of them. ",
      baked_for, closeness(*best.alike), closeness(*best.paper), where,
      fall_between(*best.paper, *best.alike, &product::CellComparison::rms_db).better);
}

/// " and by 2.73 dB (the paper's 3.99 dB) at 3 views that were baked"; empty without such views.
std::string found_on_grid(const ResultsPlan& plan, const std::vector<ResultsRow>& rows, const ResultsRow& best) {
  ResultsCase of = best.of;
  of.kind = ViewKind::OnGrid;
  const ResultsRow* row = find_row(rows, of);
  if (summary_cell(row) == nullptr) return {};
  const ResultsRow* paper = by(Method::Paper, *row, plan, rows);
  const std::string beside = paper == nullptr || paper == row ? "" : fmt::format(" (the paper's {})", rms_text(*paper));
  return fmt::format(" and by {}{} at {} that {} baked", rms_text(*row), beside, counted(row->views, "view", "views"),
                     row->views == 1 ? "was" : "were");
}

/// How far the best maps are from traced ones, and what keeps them there.
std::string found_of_the_best(const ResultsPlan& plan, const Best& best, const std::vector<ResultsRow>& rows) {
  std::string text = fmt::format("The best maps, *{}*, differ by {}", name_of(*best.of_all), closeness(*best.of_all));
  const std::string on_grid = found_on_grid(plan, rows, *best.of_all);
  if (best.paper_alike != nullptr && best.paper_alike != best.of_all) {
    text +=
        fmt::format(", where the paper's method from as many directions differs by {}", rms_text(*best.paper_alike));
    if (!on_grid.empty()) text += ",";
  }
  text += on_grid;
  const auto both = with_own_look(*best.of_all, rows);
  if (const auto share = both ? both->share_of_missing_angles() : std::nullopt) {
    text +=
        fmt::format("; what keeps them from the truth most is missing angles, at least {:.0f} % of their squared error",
                    100.0 * *share);
  }
  return text + ". ";
}

/// What a map takes, and how closely any could be told from the truth.
std::string found_of_time_and_truth(const ResultsRow& best) {
  const product::CellComparison& floor = summary_cell(&best)->floor_median;
  return fmt::format(
      "Such a map takes {:.2f} s of processor time, a path-traced one of {} rays a cell {:.0f} s; and since two traced "
      "maps of one view differ by {} dB themselves, no error below half of that, {} dB, can be shown.",
      best.render_ms / 1e3, best.rays.fewest, best.trace_seconds, number_text(floor.rms_db, 2),
      number_text(least_error(floor.rms_db), 2));
}

}  // namespace

const ResultsRow* best_combination(const ResultsPlan& plan, const std::vector<ResultsRow>& rows,
                                   std::uintmax_t most_bytes) {
  const ResultsRow* best = nullptr;
  for (const ResultsRow& row : rows) {
    const ResultsCase& of = row.of;
    const bool is_way = is_from_a_grid(of, plan) && of.scene == plan.scene_name() && of.kind == ViewKind::HeldOut &&
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
                        {"paper, as many looks as the best", best->paper_alike}};
  std::string text = fmt::format("Medians over {} held-out views at {:.0f} m cells; seconds are of the processor.\n\n",
                                 best->paper->views, summary_cell_m);
  text += way_heads;
  const TracedRays& rays = best->paper->rays;
  text += fmt::format("| *truth* | one traced map against another, {} rays a cell | {} | | | {:.2f}{} |\n", rays.text(),
                      metrics_text(best->paper->at_cell(summary_cell_m)->floor_median), best->paper->trace_seconds,
                      rays.most > rays.fewest ? fmt::format(" with {}", rays.fewest) : "");
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
  return found_from_the_papers_looks(plan, *best) + found_of_the_best(plan, *best, rows) +
         found_of_time_and_truth(*best->of_all) + "\n\n";
}

}  // namespace sigmascape::cli
