#include "results/tracing.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
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

std::string rms_text(const ResultsRow& row) {
  return number_text(rms_of(row), 2) + " dB";
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

/// From how many maps on a bake pays; empty where maps of the textures take longer than traced ones.
std::string worth_of_bake(const ResultsRow& baked, const ResultsRow& traced) {
  const double saved_s = seconds_of(traced) - seconds_of(baked);
  if (saved_s <= 0.0) return {};
  return fmt::format("; against that, from {:.0f} maps on the bake is the shorter way",
                     std::ceil(baked.atlas.bake_seconds / saved_s));
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

/// Why nothing is said of maps of fewer rays.
std::string none_fewer(const ResultsRow& traced) {
  return traced.of.baked_samples > 1 ? "fewer were not traced" : "there are no fewer";
}

/// Which of the traced maps comes as close as a baked one, and what it takes.
std::string equal_text(const ResultsRow& baked, const std::vector<const ResultsRow*>& traced) {
  const std::string found = fmt::format("- {}, {}: {} in {} s. ", way_text(baked.of), baked.of.grid, rms_text(baked),
                                        two_digits(seconds_of(baked)));
  const auto [enough, too_few] = equal_tracing(baked, traced);
  if (enough == nullptr) {
    return found + fmt::format("None of these traced maps comes as close: that of {} has {} in {}\n", rays_of(*too_few),
                               rms_text(*too_few), time_beside(*too_few, baked));
  }
  if (too_few == nullptr) {
    return found + fmt::format("The traced map of {} is closer already, {} in {} s, and {}{}\n", rays_of(*enough),
                               rms_text(*enough), two_digits(seconds_of(*enough)), none_fewer(*enough),
                               seconds_of(*enough) <= seconds_of(baked) ? ": here the bake does not pay" : "");
  }
  return found + fmt::format("Of the traced maps that of {} is the first to come as close, {} in {}{}\n",
                             rays_of(*enough), rms_text(*enough), time_beside(*enough, baked),
                             worth_of_bake(baked, *enough));
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
  text += fmt::format("| *truth* | | {} | {} | {} |\n", any.rays.text(), floor_text(any, *summary_cell(&any)),
                      two_digits(any.trace_seconds));
  for (const ResultsRow* row : traced) text += line_of(*row, "", fmt::format("{}", row->of.baked_samples));
  const auto all_baked = baked(plan, rows);
  for (const ResultsRow* row : all_baked) text += line_of(*row, row->of.grid, rays_text(row->of.baked_samples));
  text += "\n";
  for (const ResultsRow* row : all_baked) text += equal_text(*row, traced);
  return text + "\n";
}

std::string speed_at_equal_error(const ResultsPlan& plan, const std::vector<ResultsRow>& rows, const ResultsRow& way) {
  const std::string takes = fmt::format("Such a map takes {} s of processor time", two_digits(seconds_of(way)));
  const auto traced = traced_with_few_rays(plan, rows);
  if (traced.empty()) return takes + ".";
  const auto [enough, too_few] = equal_tracing(way, traced);
  if (enough == nullptr) {
    return fmt::format("{}; no path-traced map of up to {} is as close, and that one takes {}.", takes,
                       rays_of(*too_few), time_beside(*too_few, way));
  }
  if (too_few == nullptr) {
    return fmt::format("{}; a path-traced one of {} is closer already, and takes {} s ({}).", takes, rays_of(*enough),
                       two_digits(seconds_of(*enough)), none_fewer(*enough));
  }
  return fmt::format("{}, a path-traced one as close {}: {} are enough, {} {} not.", takes, time_beside(*enough, way),
                     rays_of(*enough), too_few->of.baked_samples, too_few->of.baked_samples == 1 ? "is" : "are");
}

}  // namespace sigmascape::cli
