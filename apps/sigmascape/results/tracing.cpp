#include "results/tracing.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <utility>

#include "results/columns.h"
#include "results/error_tables.h"

namespace sigmascape::cli {
namespace {

double seconds_of(const ResultsRow& row) {
  return row.render_ms / 1e3;
}

std::vector<const ResultsRow*> traced_with_few_rays(const ResultsPlan& plan, const std::vector<ResultsRow>& rows) {
  std::vector<const ResultsRow*> traced;
  for (const std::uint32_t samples : ResultsPlan::few_traced_samples) {
    const ResultsRow* row =
        find_row(rows, {.scene = plan.scene_name(), .method = Method::Traced, .grid = {}, .baked_samples = samples});
    if (summary_cell(row) != nullptr) traced.push_back(row);
  }
  return traced;
}

/// Ours on its own ground from every grid, as planned and as baked by default.
std::vector<const ResultsRow*> baked(const ResultsPlan& plan, const std::vector<ResultsRow>& rows) {
  std::vector<const ResultsRow*> found;
  for (const auto& [samples, change] : {std::pair(plan.baked_samples, ""), {0U, adaptive_change}}) {
    for (const LookGrid& grid : plan.grids) {
      const ResultsRow* row = find_row(rows, {.scene = plan.scene_name(),
                                              .method = Method::OwnGround,
                                              .grid = grid.name(),
                                              .baked_samples = samples,
                                              .change = change});
      if (summary_cell(row) != nullptr) found.push_back(row);
    }
  }
  return found;
}

std::string line_of(const ResultsRow& row, const std::string& looks, const std::string& rays) {
  return fmt::format("| {} | {} | {} | {} | {:.2f} |\n", way_text(row.of), looks, rays,
                     metrics_text(row, *summary_cell(&row)), seconds_of(row));
}

/// "14.4 s, 45.1 times as long".
std::string time_beside(const ResultsRow& traced, const ResultsRow& baked) {
  return fmt::format("{:.1f} s, {:.1f} times as long", seconds_of(traced), seconds_of(traced) / seconds_of(baked));
}

/// From how many maps on a bake pays; empty where maps of the textures take longer than traced ones.
std::string worth_of_bake(const ResultsRow& baked, const ResultsRow& traced) {
  const double saved_s = seconds_of(traced) - seconds_of(baked);
  if (saved_s <= 0.0) return {};
  return fmt::format(": from {:.0f} maps on the bake is the shorter way",
                     std::ceil(baked.atlas.bake_seconds / saved_s));
}

/// Which of the traced maps comes as close as a baked one, and what it takes.
std::string equal_text(const ResultsRow& baked, const std::vector<const ResultsRow*>& traced) {
  const double rms_db = summary_cell(&baked)->median.rms_db;
  const std::string found = fmt::format("- {}, {}: {} dB in {:.2f} s. ", way_text(baked.of), baked.of.grid,
                                        number_text(rms_db, 2), seconds_of(baked));
  const auto equal = std::ranges::find_if(
      traced, [rms_db](const ResultsRow* row) { return summary_cell(row)->median.rms_db <= rms_db; });
  if (equal == traced.end()) {
    const ResultsRow& closest = *traced.back();
    return found + fmt::format("None of these traced maps comes as close, that of {} rays takes {}\n",
                               closest.of.baked_samples, time_beside(closest, baked));
  }
  return found + fmt::format("Of the traced maps that of {} rays a cell comes as close, {} dB in {}{}\n",
                             (*equal)->of.baked_samples, number_text(summary_cell(*equal)->median.rms_db, 2),
                             time_beside(**equal, baked), worth_of_bake(baked, **equal));
}

}  // namespace

std::string tracing_section(const ResultsPlan& plan, const std::vector<ResultsRow>& rows) {
  const auto traced = traced_with_few_rays(plan, rows);
  if (traced.empty()) return {};
  std::string text = fmt::format(
      "### What tracing to the same error takes\n\nPath-traced maps of few rays have no fault but noise. Held against "
      "the same truth, with random numbers of their own: medians over the {} held-out views at {:.0f} m cells, and in "
      "brackets the worst; processor time.\n\n"
      "| map | looks | rays a cell, a texel | {} | one map [s] |\n|---|---|---:|{}|---:|\n",
      traced.front()->views, summary_cell_m, metric_heads, metric_rules);
  for (const ResultsRow* row : traced) text += line_of(*row, "", fmt::format("{}", row->of.baked_samples));
  const auto all_baked = baked(plan, rows);
  for (const ResultsRow* row : all_baked) text += line_of(*row, row->of.grid, rays_text(row->of.baked_samples));
  text += "\n";
  for (const ResultsRow* row : all_baked) text += equal_text(*row, traced);
  return text + "\n";
}

}  // namespace sigmascape::cli
