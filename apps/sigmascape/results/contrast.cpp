#include "results/contrast.h"

#include <algorithm>
#include <cmath>
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

PairedFall fall_between(const ResultsRow& from, const ResultsRow& to, double product::CellComparison::*error) {
  PairedFall fall;
  double sum = 0.0;
  for (const ResultsAtView& before : from.at_views) {
    const auto after = std::ranges::find_if(to.at_views, [&](const ResultsAtView& view) {
      return view.azimuth_deg == before.azimuth_deg && view.elevation_deg == before.elevation_deg;
    });
    if (after == to.at_views.end()) continue;
    const double falls_by = before.tested.*error - after->tested.*error;
    if (std::isnan(falls_by)) continue;
    sum += falls_by;
    ++fall.views;
    fall.better += falls_by > 0.0 ? 1U : 0U;
  }
  if (fall.views > 0) fall.mean = sum / static_cast<double>(fall.views);
  return fall;
}

std::string fall_text(const PairedFall& fall) {
  if (fall.views == 0) return "– | –";
  return fmt::format("{} | {} of {}", signed_text(fall.mean, 2), fall.better, fall.views);
}

std::string truth_line(const ResultsPlan& plan, const std::vector<ResultsRow>& rows, ViewKind kind,
                       const char* empty_cells) {
  const product::CellComparison* floor = noise_floor(plan, rows, plan.scene_name(), kind);
  if (floor == nullptr) return {};
  return fmt::format("| *truth* | one traced map against another | {} |{}\n", error_text(*floor), empty_cells);
}

}  // namespace sigmascape::cli
