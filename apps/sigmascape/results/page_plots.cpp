#include <algorithm>
#include <fmt/format.h>

#include "results/combinations.h"
#include "results/page.h"

namespace sigmascape::cli {
namespace {

constexpr const char* noise_floor_name = "least that can be shown";
constexpr Method methods[] = {Method::Paper, Method::BakedShadows, Method::LevelGround, Method::OwnGround,
                              Method::Apart};

/// A level line, as far as the points of a plot reach, at half of what two traced maps of held-out views differ by:
/// what the noise of their mean leaves of a map without fault.
void add_noise_floor(Plot& plot, const ResultsReport& report) {
  const auto* traced = noise_floor(report.plan, report.rows, report.plan.scene_name(), ViewKind::HeldOut);
  if (traced == nullptr) return;
  PlotSeries floor{.name = noise_floor_name, .joined = true, .dots = false};
  std::vector<double> reached;
  for (const PlotSeries& series : plot.series) {
    for (const auto& [x, y] : series.points) reached.push_back(x);
  }
  if (reached.empty()) return;
  const auto [first, last] = std::ranges::minmax(reached);
  const double least_db = least_error(traced->rms_db);
  floor.points = {{first, least_db}, {last, least_db}};
  plot.series.push_back(floor);
}

/// RMS error of every view, from the paper's grid, over how far its line of sight is from the nearest baked one.
Plot by_distance(const ResultsReport& report) {
  const ResultsPlan& plan = report.plan;
  Plot plot{.title = fmt::format("Error by distance from the nearest look of the {} grid, one point a view",
                                 plan.paper_grid().name()),
            .x_label = "angle between lines of sight [°]",
            .y_label = fmt::format("RMS at {:.0f} m cells [dB]", summary_cell_m)};
  for (const Method method : methods) {
    PlotSeries& series = plot.series.emplace_back(PlotSeries{.name = text_of(method)});
    for (const ViewResult& view : report.views) {
      const ResultsCase plain{.scene = plan.scene_name(),
                              .method = method,
                              .grid = plan.paper_grid().name(),
                              .baked_samples = plan.baked_samples,
                              .kind = view.of.kind};
      const product::CellComparison* cell = view.comparison.at_cell(summary_cell_m);
      if (view.of != plain || cell == nullptr) continue;
      series.points.emplace_back(ResultsPlan::distance_deg(view.view, plan.paper_grid()), cell->rms_db);
    }
  }
  add_noise_floor(plot, report);
  return plot;
}

/// One way to a map from every grid that it was measured from, by bytes; grids are named at the points of the paper's
/// method and of ours, between which the others crowd.
PlotSeries from_every_grid(const ResultsReport& report, ResultsCase way) {
  PlotSeries series{.name = way_text(way), .joined = true};
  for (const LookGrid& grid : report.plan.grids) {
    way.grid = grid.name();
    const ResultsRow* row = find_row(report.rows, way);
    const ResultsCell* cell = summary_cell(row);
    if (cell == nullptr) continue;
    series.points.emplace_back(static_cast<double>(row->atlas.store_bytes) / 1e6, cell->median.rms_db);
    const bool is_named = way.change.empty() && (way.method == Method::Paper || way.method == Method::OwnGround);
    if (is_named) series.labels.push_back(grid.name());
  }
  return series;
}

Plot by_bytes(const ResultsReport& report) {
  const ResultsPlan& plan = report.plan;
  Plot plot{.title = "Error of held-out views by bytes stored",
            .x_label = "store [MB]",
            .y_label = fmt::format("RMS at {:.0f} m cells [dB]", summary_cell_m),
            .x_is_logarithmic = true};
  for (const Method method : methods)
    plot.series.push_back(from_every_grid(
        report, {.scene = plan.scene_name(), .method = method, .grid = {}, .baked_samples = plan.baked_samples}));
  PlotSeries as_usual = from_every_grid(report, {.scene = plan.scene_name(),
                                                 .method = Method::OwnGround,
                                                 .grid = {},
                                                 .baked_samples = 0,
                                                 .change = adaptive_change});
  as_usual.name = fmt::format("the same, {}", adaptive_change);
  if (!as_usual.points.empty()) plot.series.push_back(as_usual);
  add_noise_floor(plot, report);
  return plot;
}

Plot by_cell(const ResultsReport& report) {
  Plot plot{.title = "Error of held-out views by cell size, the " + report.plan.paper_grid().name() + " grid",
            .x_label = "cell [m]",
            .y_label = "RMS [dB]",
            .x_is_logarithmic = true,
            .x_marks = {2.0, 4.0, 8.0, 16.0, 32.0}};
  PlotSeries floor{.name = noise_floor_name, .joined = true};
  for (const Method method : methods) {
    const ResultsRow* row = find_row(report.rows, {.scene = report.plan.scene_name(),
                                                   .method = method,
                                                   .grid = report.plan.paper_grid().name(),
                                                   .baked_samples = report.plan.baked_samples});
    if (row == nullptr) continue;
    PlotSeries& series = plot.series.emplace_back(PlotSeries{.name = text_of(method), .joined = true});
    floor.points.clear();
    for (const ResultsCell& cell : row->cells) {
      series.points.emplace_back(cell.median.cell_m, cell.median.rms_db);
      floor.points.emplace_back(cell.floor_median.cell_m, least_error(cell.floor_median.rms_db));
    }
  }
  plot.series.push_back(floor);
  return plot;
}

}  // namespace

std::vector<std::pair<std::string, Plot>> plots_of(const ResultsReport& report) {
  return {{"error_by_distance.svg", by_distance(report)},
          {"error_by_bytes.svg", by_bytes(report)},
          {"error_by_cell.svg", by_cell(report)}};
}

}  // namespace sigmascape::cli
