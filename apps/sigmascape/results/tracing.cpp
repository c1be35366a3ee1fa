#include "results/tracing.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <optional>
#include <tuple>
#include <utility>

#include "results/columns.h"
#include "results/error_tables.h"
#include "words.h"

namespace sigmascape::cli {
namespace {

double seconds_of(const ResultsRow& row) {
  return row.render_ms / 1e3;
}

double rms_of(const ResultsRow& row) {
  return summary_cell(&row)->median.rms_db;
}

/// Fewest first. Medians are held against one another, so that what only some of the views were traced with is left
/// out.
std::vector<const ResultsRow*> traced_with_few_rays(const ResultsPlan& plan, const std::vector<ResultsRow>& rows) {
  std::vector<const ResultsRow*> traced;
  for (const std::uint32_t samples : ResultsPlan::few_traced_samples) {
    const ResultsRow* row =
        find_row(rows, {.scene = plan.scene_name(), .method = Method::Traced, .grid = {}, .baked_samples = samples});
    if (summary_cell(row) != nullptr) traced.push_back(row);
  }
  std::size_t most_views = 0;
  for (const ResultsRow* row : traced) most_views = std::max(most_views, row->views);
  std::erase_if(traced, [most_views](const ResultsRow* row) { return row->views < most_views; });
  return traced;
}

/// Ours on its own ground from every grid, as planned, with buildings apart and as baked by default.
std::vector<const ResultsRow*> baked(const ResultsPlan& plan, const std::vector<ResultsRow>& rows) {
  std::vector<const ResultsRow*> found;
  for (const auto& [method, samples, change] : {std::tuple(Method::OwnGround, plan.baked_samples, ""),
                                                {Method::Apart, plan.baked_samples, ""},
                                                {Method::OwnGround, 0U, adaptive_change}}) {
    for (const LookGrid& grid : plan.grids) {
      const ResultsRow* row = find_row(rows, {.scene = plan.scene_name(),
                                              .method = method,
                                              .grid = grid.name(),
                                              .baked_samples = samples,
                                              .change = change});
      if (summary_cell(row) != nullptr) found.push_back(row);
    }
  }
  return found;
}

std::string line_of(const ResultsRow& row, const std::string& looks, const std::string& rays) {
  return fmt::format("| {} | {} | {} | {} | {} |\n", way_text(row.of), looks, rays,
                     metrics_text(row, *summary_cell(&row)), two_digits(seconds_of(row)));
}

/// "1 ray a cell", "16 rays a cell".
std::string rays_of(const ResultsRow& traced) {
  return counted(traced.of.baked_samples, "ray", "rays") + " a cell";
}

/// "14 s, 45 times as long".
std::string time_beside(const ResultsRow& traced, const ResultsRow& baked) {
  return fmt::format("{} s, {} times as long", two_digits(seconds_of(traced)),
                     two_digits(seconds_of(traced) / seconds_of(baked)));
}

/// "between 3.9 s and 15 s, 11 to 43 times as long".
std::string time_between(const ResultsRow& less, const ResultsRow& more, const ResultsRow& baked) {
  return fmt::format("between {} s and {} s, {} to {} times as long", two_digits(seconds_of(less)),
                     two_digits(seconds_of(more)), two_digits(seconds_of(less) / seconds_of(baked)),
                     two_digits(seconds_of(more) / seconds_of(baked)));
}

/// From how many maps on a bake pays against maps that take as long as a traced one; nothing where those of the
/// textures take longer.
std::optional<double> maps_that_pay(const ResultsRow& baked, const ResultsRow& traced) {
  const double saved_s = seconds_of(traced) - seconds_of(baked);
  return saved_s > 0.0 ? std::optional(std::ceil(baked.atlas.bake_seconds / saved_s)) : std::nullopt;
}

/// The same where a map as close takes as long as something between the two.
std::string worth_of_bake(const ResultsRow& baked, const ResultsRow& less, const ResultsRow& more) {
  const auto fewest = maps_that_pay(baked, more), most = maps_that_pay(baked, less);
  if (!fewest) return ": here the bake does not pay";
  if (!most) return fmt::format("; from {:.0f} maps on at the earliest the bake is the shorter way", *fewest);
  const std::string maps =
      fewest == most ? fmt::format("{:.0f}", *fewest) : fmt::format("{:.0f} to {:.0f}", *fewest, *most);
  return fmt::format("; from {} maps on the bake is the shorter way", maps);
}

/// The fewest rays with which a traced map comes as close as a baked one, and the next fewer, which are not enough.
struct EqualTracing {
  const ResultsRow *enough, *too_few;  ///< nullptr where none are, and where fewer were not traced
};

EqualTracing equal_tracing(const ResultsRow& baked, const std::vector<const ResultsRow*>& traced) {
  EqualTracing equal{nullptr, nullptr};
  for (const ResultsRow* row : traced) {
    if (rms_of(*row) <= rms_of(baked)) {
      equal.enough = row;
      break;
    }
    equal.too_few = row;
  }
  return equal;
}

/// Whether a map of fewer rays than were traced may be as close too.
bool may_be_fewer(const EqualTracing& equal) {
  return equal.too_few == nullptr && equal.enough->of.baked_samples > 1;
}

/// Which of the traced maps comes as close as a baked one, and what it takes.
std::string equal_text(const ResultsRow& baked, const std::vector<const ResultsRow*>& traced) {
  const std::string found = fmt::format("- {}, {}: {} in {} s. ", way_text(baked.of), baked.of.grid, rms_text(baked),
                                        two_digits(seconds_of(baked)));
  const EqualTracing equal = equal_tracing(baked, traced);
  const auto [enough, too_few] = equal;
  if (enough == nullptr) {
    return found + fmt::format("None of these traced maps comes as close: that of {} has {} in {}\n", rays_of(*too_few),
                               rms_text(*too_few), time_beside(*too_few, baked));
  }
  if (may_be_fewer(equal)) {
    const bool pays = seconds_of(*enough) > seconds_of(baked);
    return found + fmt::format("The traced map of {} is closer already, {} in {} s, and fewer were not traced{}\n",
                               rays_of(*enough), rms_text(*enough), two_digits(seconds_of(*enough)),
                               pays ? "" : ": here the bake does not pay");
  }
  if (too_few == nullptr) {
    return found + fmt::format("The traced map of a single ray a cell is closer, {} in {}{}\n", rms_text(*enough),
                               time_beside(*enough, baked), worth_of_bake(baked, *enough, *enough));
  }
  return found + fmt::format("A traced map as close takes {}: with {} it has {}, with {} {}{}\n",
                             time_between(*too_few, *enough, baked), rays_of(*too_few), rms_text(*too_few),
                             enough->of.baked_samples, rms_text(*enough), worth_of_bake(baked, *too_few, *enough));
}

}  // namespace

std::string tracing_section(const ResultsPlan& plan, const std::vector<ResultsRow>& rows) {
  const auto traced = traced_with_few_rays(plan, rows);
  if (traced.empty()) return {};
  std::string text = fmt::format(
      "## What tracing to the same error takes\n\nPath-traced maps of few rays have no fault but noise. Held against "
      "the same truth, with random numbers of their own: medians over the {} held-out views at {:.0f} m cells, and in "
      "brackets the worst; processor time. Row *truth* is one of the truth's two traced maps against the other: at "
      "least half of that is in every error here.\n\n"
      "| map | looks | rays a cell, a texel | {} | one map [s] |\n|---|---|---:|{}|---:|\n",
      traced.front()->views, summary_cell_m, metric_heads, metric_rules);
  const ResultsRow& any = *traced.front();
  text += fmt::format("| *truth* | | {} | {} | {}{} |\n", any.rays.text(), floor_text(any, *summary_cell(&any)),
                      two_digits(any.trace_seconds), any.rays.with_fewest());
  for (const ResultsRow* row : traced) text += line_of(*row, "", fmt::format("{}", row->of.baked_samples));
  const auto all_baked = baked(plan, rows);
  for (const ResultsRow* row : all_baked) text += line_of(*row, row->of.grid, rays_text(row->of.baked_samples));
  text += "\n";
  for (const ResultsRow* row : all_baked) text += equal_text(*row, traced);
  return text + "\n";
}

std::string speed_at_equal_error(const ResultsPlan& plan, const std::vector<ResultsRow>& rows, const ResultsRow& way) {
  const std::string takes = fmt::format("takes {} s of processor time", two_digits(seconds_of(way)));
  const auto traced = traced_with_few_rays(plan, rows);
  if (traced.empty()) return takes + ".";
  const EqualTracing equal = equal_tracing(way, traced);
  const auto [enough, too_few] = equal;
  if (enough == nullptr) {
    return fmt::format("{}; no path-traced map of up to {} is as close, and that one takes {}.", takes,
                       rays_of(*too_few), time_beside(*too_few, way));
  }
  if (may_be_fewer(equal)) {
    return fmt::format("{}; a path-traced one of {} is closer already, and takes {} s (fewer were not traced).", takes,
                       rays_of(*enough), two_digits(seconds_of(*enough)));
  }
  if (too_few == nullptr) {
    return fmt::format("{}; a path-traced one of a single ray a cell is closer, and takes {}.", takes,
                       time_beside(*enough, way));
  }
  return fmt::format("{}, a path-traced one as close {}: {} {} too few, {} more than enough.", takes,
                     time_between(*too_few, *enough, way), rays_of(*too_few),
                     too_few->of.baked_samples == 1 ? "is" : "are", enough->of.baked_samples);
}

}  // namespace sigmascape::cli
