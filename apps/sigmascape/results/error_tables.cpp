#include "results/error_tables.h"

#include <cmath>
#include <fmt/format.h>
#include <tuple>
#include <vector>

#include "results/columns.h"
#include "results/costs.h"

#include "sigmascape/bake/sampling.h"

namespace sigmascape::cli {
namespace {

constexpr const char* floor_and_cost_heads = "of the truth: correlation, RMS [dB], shadow IoU | store [MB] | bake [s]";
constexpr const char* floor_and_cost_rules = "---|---:|---:";

/// How well two traced maps agree at that cell size, and what the atlas takes.
std::string floor_and_cost(const ResultsCell& cell, const ResultsRow& row) {
  const product::CellComparison& floor = cell.floor_median;
  return fmt::format("{}, {}, {} | {} | {:.0f}", number_text(floor.correlation_db, 3), number_text(floor.rms_db, 2),
                     number_text(floor.shadow_iou, 2), megabytes(row.atlas.store_bytes), row.atlas.bake_seconds);
}

bool is_side_grid(const ResultsRow& row, const ResultsPlan& plan) {
  const std::string& grid = row.of.grid;
  return grid == plan.more_elevations().name() || grid == plan.more_azimuths().name() ||
         grid == plan.even_in_cotangent().name();
}

/// A line of the summary; one of several grids has the costs of each.
struct SummaryLine {
  ResultsCase of;
  std::size_t views = 0;
  std::string metrics;
  std::string grids = {}, store_mb = {}, bake_s = {};  ///< all empty of the truth

  [[nodiscard]] bool is_as(const SummaryLine& other) const {
    return of.scene == other.of.scene && of.kind == other.of.kind && of.method == other.of.method &&
           of.change == other.of.change && metrics == other.metrics;
  }
  void take_in(const SummaryLine& other) {
    grids += "; " + other.grids;
    store_mb += "; " + other.store_mb;
    bake_s += "; " + other.bake_s;
  }
};

SummaryLine line_of(const ResultsRow& row, const ResultsCell& cell) {
  return {row.of,
          row.views,
          metrics_text(row, cell),
          row.of.grid,
          megabytes(row.atlas.store_bytes),
          fmt::format("{:.0f}", row.atlas.bake_seconds)};
}

/// At how many of so many views an aim is reached.
struct Reached {
  std::size_t views = 0, of = 0;
};

/// "reached, 2 of 3".
std::string mark(bool median_reaches, const Reached& reached) {
  return fmt::format("{}, {} of {}", median_reaches ? "reached" : "missed", reached.views, reached.of);
}

/// Three cells: a correlation, its aim, and whether it was reached.
std::string correlation_beside(double least, double correlation, const Reached& reached) {
  return fmt::format("{} | {:.2f} | {}", number_text(correlation, decimals_that_tell(correlation, least, 3)), least,
                     mark(correlation >= least, reached));
}

/// The views of a row whose number, without its sign, is no less or no more than an aim.
Reached views_with(const ResultsRow& row, double product::CellComparison::*number, auto reaches) {
  const auto does = [&](const ResultsAtView& view) { return reaches(std::abs(view.tested.*number)); };
  return {static_cast<std::size_t>(std::ranges::count_if(row.at_views, does)), row.at_views.size()};
}

/// How well two traced maps of a view agree, which bounds what can be shown of any method.
std::string truth_aim(const ResultsReport& report, const std::string& scene, ViewKind kind) {
  const product::CellComparison* floor = noise_floor(report.plan, report.rows, scene, kind);
  if (floor == nullptr) return {};
  const ResultsRow& row = *baseline_row(report.plan, report.rows, scene, kind);
  return fmt::format("|{} {} | *truth*, {} rays a cell | | | {} | {} | | |\n", SceneColumn(report.plan).cell(scene),
                     text_of(kind), traced_rays(report.plan, report.rows, scene, kind).text(),
                     correlation_beside(least_agreement, floor->correlation_db, {row.agreeing_views, row.views}),
                     signed_text(floor->bias_db, 2));
}

/// A row beside its aims.
std::string aim_line(const ResultsReport& report, const ResultsRow& row, const ResultsCell& cell, double least) {
  constexpr double most_bias_db = 0.3;
  const double bias_db = cell.median.bias_db;
  std::vector<double> sizes_db;
  for (const ResultsAtView& view : row.at_views) sizes_db.push_back(std::abs(view.tested.bias_db));
  const Reached correlating = views_with(row, &product::CellComparison::correlation_db,
                                         [least](double correlation) { return correlation >= least; });
  const Reached unbiased =
      views_with(row, &product::CellComparison::bias_db, [](double size_db) { return size_db <= most_bias_db; });
  return fmt::format("|{} {} | {} | {} | {:.1f} | {} | {} ({}) | ±{:g} | {} |\n",
                     SceneColumn(report.plan).cell(row.of.scene), text_of(row.of.kind), way_text(row.of),
                     rays_text(row.of.baked_samples), row.atlas.bake_seconds / static_cast<double>(row.atlas.looks),
                     correlation_beside(least, cell.median.correlation_db, correlating),
                     signed_text(bias_db, decimals_that_tell(most_bias_db, std::abs(bias_db), 2)),
                     signed_text(cell.worst.bias_db, 2), most_bias_db,
                     mark(median(sizes_db) <= most_bias_db, unbiased));
}

/// Views that were baked, from the grid as it is measured, from the same looks with rays where the noise is, as they
/// are baked by default, and with as many rays as the truth has, on texels half as wide as well.
std::string aims_of_scene(const ResultsReport& report, const std::string& scene, double least) {
  const ResultsPlan& plan = report.plan;
  std::string text = truth_aim(report, scene, ViewKind::OnGrid);
  for (const Method method : {Method::Paper, Method::LevelGround, Method::OwnGround, Method::Apart}) {
    for (const auto& [grid, samples, change] :
         {std::tuple(plan.paper_grid().name(), plan.baked_samples, ""),
          {std::string(own_look), 0U, adaptive_change},
          {std::string(own_look), plan.finer_samples, ""},
          {std::string(own_look), plan.samples_of_finer_texels(), finer_texels_change}}) {
      const ResultsRow* row = find_row(report.rows, {.scene = scene,
                                                     .method = method,
                                                     .grid = grid,
                                                     .baked_samples = samples,
                                                     .kind = ViewKind::OnGrid,
                                                     .change = change});
      const ResultsCell* cell = summary_cell(row);
      if (cell != nullptr) text += aim_line(report, *row, *cell, least);
    }
  }
  return text;
}

std::string cell_heads() {
  return fmt::format("| views | method | looks | cell [m] | {} | {} |\n|---|---|---|---:|{}|{}|\n", metric_heads,
                     floor_and_cost_heads, metric_rules, floor_and_cost_rules);
}

/// A line below cell_heads for each cell size.
std::string lines_by_cell(const ResultsRow& row) {
  std::string text;
  for (const ResultsCell& cell : row.cells) {
    text += fmt::format("| {} | {} | {} | {:.0f} | {} | {} |\n", text_of(row.of.kind), way_text(row.of), row.of.grid,
                        cell.median.cell_m, metrics_text(row, cell), floor_and_cost(cell, row));
  }
  return text;
}

/// Every method from every grid that it has, at views of every kind.
std::string cells_of_every_grid(const ResultsReport& report) {
  const ResultsPlan& plan = report.plan;
  std::string text = cell_heads();
  for (const ResultsRow& row : report.rows) {
    if (row.of.scene == plan.scene_name() && is_of_a_grid(row, plan)) text += lines_by_cell(row);
  }
  return text;
}

}  // namespace

std::string rays_text(std::uint32_t samples) {
  if (samples != 0) return fmt::format("{}", samples);
  const bake::Sampling adaptive;
  return fmt::format("to {:g} dB, at most {}", adaptive.target_db, adaptive.most_samples);
}

std::string summary_section(const ResultsReport& report) {
  const ResultsPlan& plan = report.plan;
  const SceneColumn scene(plan);
  std::string text =
      fmt::format(
          "## Every method and grid of looks, at {:.0f} m cells\n\nMedians over the views, whose number stands behind "
          "their kind, and in brackets the worst. Grids from which all numbers are the same, for they hold the same "
          "looks "
          "of these views, share a row.\n\n"
          "|{} views | method | looks | {} | store [MB] | bake [s] |\n",
          summary_cell_m, scene.head(), metric_heads) +
      fmt::format("|{}---|---|---|{}|---:|---:|\n", scene.rule(), metric_rules);
  std::vector<SummaryLine> lines;
  std::string last;
  for (const ResultsRow& row : report.rows) {
    const ResultsCell* cell = row.at_cell(summary_cell_m);
    if (cell == nullptr || !is_of_a_grid(row, plan) || is_side_grid(row, plan)) continue;
    const std::string group = row.of.scene + text_of(row.of.kind);
    if (group != last) {
      lines.push_back({row.of, row.views, floor_text(row, *cell)});
    }
    last = group;
    const SummaryLine line = line_of(row, *cell);
    if (!lines.back().grids.empty() && lines.back().is_as(line)) {
      lines.back().take_in(line);
    } else {
      lines.push_back(line);
    }
  }
  for (const SummaryLine& line : lines) {
    text += fmt::format("|{} {} ({}) | {} | {} | {} | {} | {} |\n", scene.cell(line.of.scene), text_of(line.of.kind),
                        line.views, line.grids.empty() ? "*truth*" : way_text(line.of), line.grids, line.metrics,
                        line.store_mb, line.bake_s);
  }
  return text + "\n";
}

std::string aims_section(const ResultsReport& report) {
  const ResultsPlan& plan = report.plan;
  const SceneColumn scene(plan);
  std::string text = fmt::format(
      "## What was aimed at, and what came out\n\nAims are set for views that were baked, and for the truth at all "
      "views; numbers are medians at {:.0f} m cells. The first row of a method, with {} rays, is from the {} grid, the "
      "others "
      "from a bake of the view's own look. *Rays where the noise is* are what `sigmascape bake` takes by itself. "
      "Whether an aim is reached is of the median, of the bias's size where that is aimed at; behind it stands at how "
      "many of the views it is, and beside the bias in brackets the worst. What {} rays bring beside {} was lost to "
      "noise, and what narrower texels bring beside these to {}.\n\n",
      summary_cell_m, plan.baked_samples, plan.paper_grid().name(), plan.finer_samples, plan.baked_samples,
      report.links.to("their width", "docs/decisions/0118-texels-and-cells.md"));
  text += fmt::format("|{} views | method | rays a texel | bake of a look [s] | ", scene.head()) +
          "correlation of dB | aim | | bias [dB] | aim | |\n";
  text += fmt::format("|{}---|---|---:|---:|---:|---:|---|---:|---:|---|\n", scene.rule());
  text += aims_of_scene(report, plan.scene_name(), 0.95);
  if (plan.has_level_ground()) text += aims_of_scene(report, "level", 0.99);
  return text + truth_aim(report, plan.scene_name(), ViewKind::HeldOut) + "\n";
}

std::string cell_section(const ResultsReport& report) {
  const ResultsPlan& plan = report.plan;
  std::string text = fmt::format("## By cell size\n\nFrom the {} grid.\n\n", plan.paper_grid().name()) + cell_heads();
  for (const ViewKind kind : {ViewKind::OnGrid, ViewKind::HeldOut, ViewKind::Paper}) {
    for (const Method method : {Method::Paper, Method::LevelGround, Method::OwnGround, Method::Apart}) {
      const ResultsRow* row = find_row(report.rows, {.scene = plan.scene_name(),
                                                     .method = method,
                                                     .grid = plan.paper_grid().name(),
                                                     .baked_samples = plan.baked_samples,
                                                     .kind = kind});
      if (row != nullptr) text += lines_by_cell(*row);
    }
  }
  return text + "\n<details>\n<summary>The same from every grid of looks</summary>\n\n" + cells_of_every_grid(report) +
         "\n</details>\n\n";
}

std::string detail_section(const ResultsReport& report) {
  const ResultsPlan& plan = report.plan;
  std::string text = fmt::format(
      "## By level of detail\n\nFrom the {} grid, ours on its own ground. LOD 1 reads textures from their finest "
      "level, each next one from mips of texels twice as wide; one store and one bake serve them all.\n\n"
      "| LOD | views | cell [m] | {} | {} |\n|---:|---|---:|{}|{}|\n",
      plan.paper_grid().name(), metric_heads, floor_and_cost_heads, metric_rules, floor_and_cost_rules);
  for (const ViewKind kind : {ViewKind::OnGrid, ViewKind::HeldOut}) {
    for (int level = 1; level <= 3; ++level) {
      const ResultsRow* row = find_row(report.rows, {.scene = plan.scene_name(),
                                                     .method = Method::OwnGround,
                                                     .grid = plan.paper_grid().name(),
                                                     .baked_samples = plan.baked_samples,
                                                     .kind = kind,
                                                     .level_of_detail = level});
      if (row == nullptr) continue;
      for (const double cell_m : {2.0, 8.0, 32.0}) {
        const ResultsCell* cell = row->at_cell(cell_m);
        if (cell == nullptr) continue;
        text += fmt::format("| {} | {} | {:.0f} | {} | {} |\n", level, text_of(kind), cell_m, metrics_text(*row, *cell),
                            floor_and_cost(*cell, *row));
      }
    }
  }
  return text + "\n";
}

}  // namespace sigmascape::cli
