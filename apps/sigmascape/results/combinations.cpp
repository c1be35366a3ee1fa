#include "results/combinations.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <optional>

#include "results/columns.h"
#include "results/contrast.h"
#include "results/costs.h"
#include "results/tracing.h"
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
  return fmt::format("| {} | {} | {} | {} | {:.0f} | {} |\n", what, name_of(row),
                     metrics_text(row.at_cell(summary_cell_m)->median), megabytes(row.atlas.store_bytes),
                     row.atlas.bake_seconds, two_digits(row.render_ms / 1e3));
}

/// A way beside the look that is each view's own, where no angle is missing.
struct WithOwnLook {
  const ResultsCell *way, *own;

  [[nodiscard]] ErrorParts parts() const {
    return error_parts(way->median.rms_db, own->median.rms_db, way->floor_median.rms_db);
  }
  [[nodiscard]] bool way_is_closer() const { return way->median.rms_db <= own->median.rms_db; }
  /// Whether more of the squared error may be missing angles than blending several looks takes off by averaging noise.
  [[nodiscard]] bool tells_of_missing_angles() const {
    constexpr double least_share = 0.1;
    return !way_is_closer() && parts().missing_angles_db2 >= least_share * parts().all_db2;
  }
  /// Whether missing angles are most of the squared error. Of no other part this can be told: a way blends several
  /// looks, whose noise averages, and the own look has all of it.
  [[nodiscard]] bool misses_angles_most() const {
    const ErrorParts of = parts();
    return !way_is_closer() && of.missing_angles_db2 >= std::max(of.truth_noise_db2, of.rest_db2);
  }
};

std::optional<WithOwnLook> with_own_look(const ResultsRow& row, const std::vector<ResultsRow>& rows) {
  ResultsCase own = row.of;
  own.grid = own_look;
  if (own.change != adaptive_change) own.change = "";
  // Looks of the views' own hold buildings: rays know of them what a map makes.
  if (own.method == Method::Apart) own.method = Method::OwnGround;
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
  if (!both->tells_of_missing_angles()) {
    return fmt::format(
               "*{}* comes {} the truth, {:.2f} dB RMS, {} a texture baked for the view itself with as many rays (its "
               "own look), {:.2f} dB: it blends several looks, whose noise averages. How much of its error missing "
               "angles are, and how much noise, these numbers do not tell. ",
               name_of(row), both->way_is_closer() ? "closer to" : "about as close to", way.rms_db,
               both->way_is_closer() ? "than" : "as", own.rms_db) +
           by_l1;
  }
  const ErrorParts parts = both->parts();
  const auto percent = [&](double db2) { return 100.0 * db2 / parts.all_db2; };
  const std::string cause = both->misses_angles_most()
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
         (row.of.method == Method::Apart
              ? "Among the missing angles counts here what maps know of buildings less well than rays do. "
              : "") +
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

/// What is compared, and how far both methods are from traced maps, from the paper's looks.
std::string found_from_the_papers_looks(const ResultsPlan& plan, const Best& best) {
  const std::string compared = fmt::format(
      "Maps rendered from baked textures are held against path-traced ones, cell by cell of {:.0f} m, at {} from "
      "directions that were not baked. From the {} directions (azimuths × elevations) "
      "of the paper that is followed here ",
      summary_cell_m, counted(best.paper->views, "view", "views"), plan.paper_grid().name());
  if (best.alike == nullptr)
    return compared + fmt::format("the paper's method is off by {} RMS in the median. ", rms_text(*best.paper));
  const PairedFall fall = fall_between(*best.paper, *best.alike, &product::CellComparison::rms_db);
  return compared +
         fmt::format(
             "ours are off by {} RMS in the median, those of the paper's method by {}; ours come closer at {}. ",
             rms_text(*best.alike), rms_text(*best.paper),
             fall.views > 0 && fall.better == fall.views ? "all of the views"
                                                         : fmt::format("{} of the views", fall.better));
}

/// Whether one way is closer than another at more of the views than it is farther off.
bool is_mostly_closer(const ResultsRow& one, const ResultsRow& other) {
  constexpr auto rms = &product::CellComparison::rms_db;
  return fall_between(other, one, rms).better > fall_between(one, other, rms).better;
}

bool is_way(const ResultsRow& row, const ResultsPlan& plan) {
  const ResultsCase& of = row.of;
  return is_from_a_grid(of, plan) && of.scene == plan.scene_name() && of.kind == ViewKind::HeldOut &&
         of.change != renormalized_change && summary_cell(&row) != nullptr &&
         !std::isnan(summary_cell(&row)->median.rms_db);
}

}  // namespace

const ResultsRow* best_combination(const ResultsPlan& plan, const std::vector<ResultsRow>& rows,
                                   std::uintmax_t most_bytes) {
  const auto rms_db = [](const ResultsRow* row) { return summary_cell(row)->median.rms_db; };
  std::vector<const ResultsRow*> ways;
  for (const ResultsRow& row : rows) {
    if (is_way(row, plan) && row.atlas.store_bytes <= most_bytes) ways.push_back(&row);
  }
  if (ways.empty()) return nullptr;
  std::ranges::stable_sort(ways, {}, rms_db);
  const ResultsRow* best = ways.front();
  for (const ResultsRow* way : ways) {
    if (rms_db(way) - rms_db(ways.front()) < least_fall_db && is_mostly_closer(*way, *best)) best = way;
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
  std::string text = fmt::format(
      "Medians over {} held-out views at {:.0f} m cells; seconds are of the processor ([the words of "
      "this page](#the-words-of-this-page)).\n\n",
      best->paper->views, summary_cell_m);
  text += way_heads;
  const TracedRays& rays = best->paper->rays;
  text += fmt::format("| *truth* | one traced map against another, {} rays a cell | {} | | | {}{} |\n", rays.text(),
                      metrics_text(best->paper->at_cell(summary_cell_m)->floor_median),
                      two_digits(best->paper->trace_seconds), rays.with_fewest());
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
  const double traced_rms_db = summary_cell(best->paper)->floor_median.rms_db;
  return text +
         fmt::format(
             "\nBest is the least RMS, and of ways within {:g} dB of the least the one that is closer at more of "
             "the views. Since two traced maps of one view differ by {} dB themselves, no error below half of "
             "that, {} dB, can be shown.\n\n",
             least_fall_db, number_text(traced_rms_db, 2), number_text(least_error(traced_rms_db), 2));
}

std::string limits_section(const ResultsPlan& plan, const std::vector<ResultsRow>& rows) {
  const auto best = best_of(plan, rows);
  if (!best) return {};
  std::string text;
  if (best->in_its_bytes != nullptr) text += limit_of(*best->in_its_bytes, rows);
  if (best->of_all != nullptr && best->of_all != best->in_its_bytes) text += limit_of(*best->of_all, rows);
  return text.empty() ? text : "## What limits the best of them\n\n" + text;
}

std::string verdict(const ResultsPlan& plan, const std::vector<ResultsRow>& rows) {
  const auto best = best_of(plan, rows);
  if (!best || best->of_all == nullptr) return {};
  return found_from_the_papers_looks(plan, *best) +
         fmt::format("The best maps, *{}*, are off by {}. ", name_of(*best->of_all), rms_text(*best->of_all)) +
         "Such a map " + speed_at_equal_error(plan, rows, *best->of_all) + "\n\n";
}

}  // namespace sigmascape::cli
