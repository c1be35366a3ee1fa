#include "results/contrast.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <utility>

#include "results/columns.h"

namespace sigmascape::cli {

std::optional<MeasuredContrast> measured(const Contrast& contrast, const std::vector<ResultsRow>& rows) {
  const ResultsRow* with = find_row(rows, contrast.with);
  const ResultsRow* without = find_row(rows, contrast.without);
  const MeasuredContrast both{with, without, summary_cell(with), summary_cell(without)};
  if (both.with_cell == nullptr || both.without_cell == nullptr) return std::nullopt;
  return both;
}

std::vector<FallAtView> falls_at_views(const ResultsRow& from, const ResultsRow& to,
                                       double product::CellComparison::*error) {
  std::vector<FallAtView> falls;
  for (const ResultsAtView& before : from.at_views) {
    const auto after = std::ranges::find_if(to.at_views, [&](const ResultsAtView& view) {
      return view.azimuth_deg == before.azimuth_deg && view.elevation_deg == before.elevation_deg;
    });
    if (after == to.at_views.end()) continue;
    const double falls_by = before.tested.*error - after->tested.*error;
    if (!std::isnan(falls_by)) falls.push_back({before.azimuth_deg, before.elevation_deg, falls_by});
  }
  return falls;
}

PairedFall paired(const std::vector<FallAtView>& falls) {
  if (falls.empty()) return {};
  PairedFall fall{.views = falls.size()};
  std::vector<double> each;
  for (const FallAtView& at_view : falls) {
    each.push_back(at_view.falls_by);
    fall.better += at_view.falls_by > 0.0 ? 1U : 0U;
    fall.mean += at_view.falls_by / static_cast<double>(falls.size());
  }
  fall.median = median(std::move(each));
  return fall;
}

PairedFall fall_between(const ResultsRow& from, const ResultsRow& to, double product::CellComparison::*error) {
  return paired(falls_at_views(from, to, error));
}

std::string fall_text(const PairedFall& fall, double PairedFall::*middle) {
  if (fall.views == 0) return "– | –";
  return fmt::format("{} | {} of {}", signed_text(fall.*middle, 2), fall.better, fall.views);
}

std::string truth_line(const ResultsPlan& plan, const std::vector<ResultsRow>& rows, ViewKind kind,
                       const char* empty_cells) {
  const product::CellComparison* floor = noise_floor(plan, rows, plan.scene_name(), kind);
  if (floor == nullptr) return {};
  return fmt::format("| *truth* | one traced map against another | {} |{}\n", error_text(*floor), empty_cells);
}

}  // namespace sigmascape::cli
