#include "results/noise_tables.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <fmt/format.h>

#include "results/columns.h"

namespace sigmascape::cli {
namespace {

/// "azimuth 135.0°, elevation 5.0°; azimuth …".
std::string repeated_views(const ResultsPlan& plan) {
  std::string text;
  for (const PlannedView& view : plan.views) {
    if (view.is_repeated) text += (text.empty() ? "" : "; ") + view.description();
  }
  return text;
}

std::ptrdiff_t repeated_count(const ResultsPlan& plan) {
  return std::ranges::count_if(plan.views, &PlannedView::is_repeated);
}

std::string range_name(const product::LevelError& range) {
  if (std::isinf(range.from_db)) return fmt::format("below {:g} dB", range.to_db);
  if (std::isinf(range.to_db)) return fmt::format("from {:g} dB", range.from_db);
  return fmt::format("{:g} to {:g} dB", range.from_db, range.to_db);
}

/// "12 % | 40 % | 5.31" of every range.
std::string shares_text(const std::vector<product::LevelError>& ranges) {
  double cells = 0.0, squares = 0.0;
  for (const product::LevelError& range : ranges) {
    cells += static_cast<double>(range.cells);
    squares += range.squared_error_db2;
  }
  const auto percent = [](double part, double whole) {
    return whole > 0.0 ? fmt::format("{:.0f} %", 100.0 * part / whole) : std::string("–");
  };
  std::string text;
  for (const product::LevelError& range : ranges) {
    const auto count = static_cast<double>(range.cells);
    text += fmt::format(" {} | {} | {} |", percent(count, cells), percent(range.squared_error_db2, squares),
                        range.cells > 0 ? fmt::format("{:.2f}", std::sqrt(range.squared_error_db2 / count)) : "–");
  }
  return text;
}

}  // namespace

std::string without_noise_section(const ResultsReport& report) {
  const SceneColumn scene(report.plan);
  std::string rows;
  for (const ResultsRow& row : report.rows) {
    const ResultsWithoutNoise& free = row.without_noise;
    if (free.views == 0) continue;
    rows += fmt::format("|{} {} | {} | {} | {} | {} | {} | {} |\n", scene.cell(row.of.scene), text_of(row.of.method),
                        row.of.baked_samples, number_text(free.noise_floor.correlation_db, 3),
                        number_text(free.measured.correlation_db, 3), number_text(free.correlation_db, 3),
                        number_text(free.measured.rms_db, 2), number_text(free.rms_db, 2));
  }
  if (rows.empty()) return {};
  return fmt::format(
             "### Without noise\n\nHow much of this is noise, and how much a fault that more rays do not mend? Views "
             "on the grid were baked as looks of their own twice, from two seeds: {}. From two bakes and two traced "
             "maps the noise of both can be taken out (`product/noise_free_metrics.h` has the equations). {}easured, "
             "and so. With {} "
             "rays a texel, as many as the truth has a cell, a bake without fault would come to a correlation of 1 and "
             "an RMS of 0 dB; with fewer its RMS stays above. A fault that noise buries is not found, so that these "
             "correlations come out somewhat too high, the more so the noisier the maps: made examples of 0.95 come "
             "out as 0.957 where two traced maps agree to 0.965.\n\n"
             "|{} method | rays a texel | two traced maps: correlation | correlation of dB | without noise | RMS "
             "[dB] | without noise |\n|{}---|---:|---:|---:|---:|---:|---:|\n",
             repeated_views(report.plan), repeated_count(report.plan) > 1 ? "Medians over these views, m" : "M",
             report.plan.traced_samples_of(ViewKind::OnGrid), scene.head(), scene.rule()) +
         rows + "\n";
}

std::string level_section(const ResultsReport& report) {
  const ResultsPlan& plan = report.plan;
  std::string heads, rows;
  const auto add = [&](ViewKind kind, const std::string& name, const std::vector<product::LevelError>& ranges) {
    if (heads.empty()) {
      for (const product::LevelError& range : ranges)
        heads += fmt::format(" {}: share of cells | of squared error | RMS [dB] |", range_name(range));
      heads += "\n|---|---|";
      for (std::size_t i = 0; i < 3 * ranges.size(); ++i) heads += "---:|";
      heads += "\n";
    }
    rows += fmt::format("| {} | {} |{}\n", text_of(kind), name, shares_text(ranges));
  };
  for (const ViewKind kind : {ViewKind::OnGrid, ViewKind::HeldOut}) {
    bool is_first = true;
    for (const auto& [method, grid] : {std::pair(Method::Paper, plan.paper_grid().name()),
                                       {Method::OwnGround, plan.paper_grid().name()},
                                       {Method::OwnGround, plan.grids.back().name()},
                                       {Method::OwnGround, std::string(own_look)}}) {
      const ResultsRow* row = find_row(report.rows, {.scene = plan.scene_name(),
                                                     .method = method,
                                                     .grid = grid,
                                                     .baked_samples = plan.baked_samples,
                                                     .kind = kind});
      if (row == nullptr) continue;
      if (is_first) add(kind, "*truth*", row->noise_by_level);
      is_first = false;
      add(kind, text_of(method) + ", " + grid, row->by_level);
    }
  }
  return fmt::format(
             "## Where the error is\n\nAll {:.0f} m cells of all views together, sorted by how bright the truth is "
             "there, its σ0: how many of the cells are so bright, how much of the map's whole squared error is theirs, "
             "and their own RMS.\n\n| views | map |",
             summary_cell_m) +
         heads + rows + "\n";
}

}  // namespace sigmascape::cli
