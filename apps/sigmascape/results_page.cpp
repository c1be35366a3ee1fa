#include "results_page.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <tuple>

#include "results_causes.h"
#include "results_combinations.h"
#include "results_noise_tables.h"

#include "sigmascape/product/software.h"

namespace sigmascape::cli {
namespace {

/// "0.834 (0.791)": median and worst, or the median alone where there is only one view.
std::string pair(double median, double worst, const char* format, std::size_t views) {
  const auto text = [&](double value) {
    return std::isnan(value) ? std::string("–") : fmt::format(fmt::runtime(format), value);
  };
  return views > 1 ? fmt::format("{} ({})", text(median), text(worst)) : text(median);
}

/// The five metrics as cells of a table.
std::string metrics_text(const product::CellComparison& median, const product::CellComparison& worst,
                         std::size_t views) {
  return fmt::format("{} | {} | {} | {} | {}", pair(median.correlation_db, worst.correlation_db, "{:.3f}", views),
                     pair(median.rms_db, worst.rms_db, "{:.2f}", views),
                     pair(median.bias_db, worst.bias_db, "{:+.2f}", views), pair(median.l1, worst.l1, "{:.3f}", views),
                     pair(median.shadow_iou, worst.shadow_iou, "{:.2f}", views));
}

constexpr const char* metric_heads = "correlation of dB | RMS [dB] | bias [dB] | relative L1 | shadow IoU";
constexpr const char* metric_rules = "---:|---:|---:|---:|---:";

std::string megabytes(std::uintmax_t bytes) {
  return fmt::format("{:.2f}", static_cast<double>(bytes) / 1e6);
}

constexpr const char* floor_and_cost_heads = "truth: correlation, RMS [dB], IoU | store [MB] | bake [s]";
constexpr const char* floor_and_cost_rules = "---|---:|---:";

/// How well two traced maps agree at that cell size, and what the atlas takes.
std::string floor_and_cost(const ResultsCell& cell, const ResultsRow& row) {
  return fmt::format("{:.3f}, {:.2f}, {:.2f} | {} | {:.0f}", cell.floor_median.correlation_db, cell.floor_median.rms_db,
                     cell.floor_median.shadow_iou, megabytes(row.atlas.store_bytes), row.atlas.bake_seconds);
}

/// Whether a row is of a whole grid, as it is by itself.
bool is_plain(const ResultsRow& row, const ResultsPlan& plan) {
  return row.of.change.empty() && row.of.level_of_detail == 1 && row.of.grid != own_look &&
         row.of.baked_samples == plan.baked_samples;
}

bool is_side_grid(const ResultsRow& row, const ResultsPlan& plan) {
  const std::string& grid = row.of.grid;
  return grid == plan.more_elevations().name() || grid == plan.more_azimuths().name() ||
         grid == plan.even_in_cotangent().name();
}

std::string summary_table(const ResultsReport& report) {
  const ResultsPlan& plan = report.plan;
  std::string text =
      fmt::format("| scene | views | method | grid | {} | store [MB] | bake [s] |\n|---|---|---|---|{}|---:|---:|\n",
                  metric_heads, metric_rules);
  std::string last;
  for (const ResultsRow& row : report.rows) {
    const ResultsCell* cell = row.at_cell(summary_cell_m);
    if (cell == nullptr || !is_plain(row, plan) || is_side_grid(row, plan)) continue;
    const std::string group = row.of.scene + text_of(row.of.kind);
    if (group != last) {
      text += fmt::format("| {} | {} ({}) | *truth* | | {} | | |\n", row.of.scene, text_of(row.of.kind), row.views,
                          metrics_text(cell->floor_median, cell->floor_worst, row.views));
    }
    last = group;
    text +=
        fmt::format("| {} | {} ({}) | {} | {} | {} | {} | {:.0f} |\n", row.of.scene, text_of(row.of.kind), row.views,
                    text_of(row.of.method), row.of.grid, metrics_text(cell->median, cell->worst, row.views),
                    megabytes(row.atlas.store_bytes), row.atlas.bake_seconds);
  }
  return text;
}

std::string cell_table(const ResultsReport& report) {
  const ResultsPlan& plan = report.plan;
  std::string text = fmt::format("| views | method | cell [m] | {} | {} |\n|---|---|---:|{}|{}|\n", metric_heads,
                                 floor_and_cost_heads, metric_rules, floor_and_cost_rules);
  for (const ViewKind kind : {ViewKind::OnGrid, ViewKind::HeldOut, ViewKind::Paper}) {
    for (const Method method : {Method::Paper, Method::LevelGround, Method::OwnGround}) {
      const ResultsRow* row = find_row(report.rows, {.scene = plan.scene_name(),
                                                     .method = method,
                                                     .grid = plan.paper_grid().name(),
                                                     .baked_samples = plan.baked_samples,
                                                     .kind = kind});
      if (row == nullptr) continue;
      for (const ResultsCell& cell : row->cells) {
        text += fmt::format("| {} | {} | {:.0f} | {} | {} |\n", text_of(kind), text_of(method), cell.median.cell_m,
                            metrics_text(cell.median, cell.worst, row->views), floor_and_cost(cell, *row));
      }
    }
  }
  return text;
}

std::string level_table(const ResultsReport& report) {
  const ResultsPlan& plan = report.plan;
  std::string text = fmt::format("| LOD | views | cell [m] | {} | {} |\n|---:|---|---:|{}|{}|\n", metric_heads,
                                 floor_and_cost_heads, metric_rules, floor_and_cost_rules);
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
        text += fmt::format("| {} | {} | {:.0f} | {} | {} |\n", level, text_of(kind), cell_m,
                            metrics_text(cell->median, cell->worst, row->views), floor_and_cost(*cell, *row));
      }
    }
  }
  return text;
}

std::string time_table(const ResultsReport& report) {
  std::string text =
      "| method | grid | looks | store [MB] | in memory [MB] | bake [s] | frame [ms] | trace [s] |\n"
      "|---|---|---:|---:|---:|---:|---:|---:|\n";
  for (const ResultsRow& row : report.rows) {
    if (row.of.scene != report.plan.scene_name() || row.of.kind != ViewKind::HeldOut || !is_plain(row, report.plan))
      continue;
    text += fmt::format("| {} | {} | {} | {} | {} | {:.0f} | {:.0f} | {:.1f} |\n", text_of(row.of.method), row.of.grid,
                        row.atlas.looks, megabytes(row.atlas.store_bytes), megabytes(row.atlas.memory_bytes),
                        row.atlas.bake_seconds, row.render_ms, row.trace_seconds);
  }
  return text;
}

std::string vertices_text(const ResultsReport& report) {
  const auto kept = static_cast<double>(report.terrain_nodes),
             all = static_cast<double>(report.meshes.instanced_vertices);
  return fmt::format(
      "The full scene has {:.4g} million vertices, each tree with its own; a rendered map knows the {} nodes of the "
      "terrain, {:.3f} % of them. To be traced, the scene takes {} MB of acceleration structures.\n\n",
      all / 1e6, report.terrain_nodes, 100.0 * kept / all, megabytes(report.tracing_memory_bytes));
}

std::string view_table(const ResultsPlan& plan) {
  std::string text = "| view | azimuth [°] | elevation [°] | from the nearest look [°] |\n|---|---:|---:|---:|\n";
  for (const PlannedView& view : plan.views) {
    text += fmt::format("| {} | {:.1f} | {:.1f} | {:.1f} |\n", text_of(view.kind), view.azimuth_deg, view.elevation_deg,
                        ResultsPlan::distance_deg(view, plan.paper_grid()));
  }
  return text;
}

/// Grids that differ above all views alone cannot be told apart.
std::string elevation_remark(const ResultsPlan& plan) {
  double highest_deg = 0.0;
  for (const PlannedView& view : plan.views) highest_deg = std::max(highest_deg, view.elevation_deg);
  const double first_grid_deg = plan.grids.front().elevations_deg.back();
  if (highest_deg > first_grid_deg) return {};
  return fmt::format("No view lies above {:.1f}°: what a grid holds beyond {:g}° is not put to the test. ", highest_deg,
                     first_grid_deg);
}

std::string grid_list(const ResultsPlan& plan) {
  std::string text;
  std::vector<LookGrid> grids = plan.grids;
  grids.push_back(plan.even_in_cotangent());
  for (const LookGrid& grid : grids)
    text += fmt::format("- {}: azimuths every {:g}°, elevations {}°\n", grid.name(), 360.0 / grid.azimuths,
                        fmt::join(grid.elevations_deg, "°, "));
  return text;
}

/// How well two traced maps agree, and what that leaves a baked map to reach: with the noise of both alike and
/// independent, a map without any correlates with their mean by √(2ρ / (1 + ρ)) of their own correlation ρ.
std::string ceiling_text(const ResultsReport& report) {
  std::string text;
  for (const ViewKind kind : {ViewKind::OnGrid, ViewKind::HeldOut}) {
    const ResultsRow* row = baseline_row(report.plan, report.rows, report.plan.scene_name(), kind);
    const ResultsCell* cell = row != nullptr ? row->at_cell(summary_cell_m) : nullptr;
    if (cell == nullptr) continue;
    const double correlation = cell->floor_median.correlation_db;
    text += fmt::format(
        "Two traced maps of one {} view correlate by {:.3f} at {:.0f} m cells, so that a baked map without fault would "
        "reach about {:.3f} against their mean. ",
        kind == ViewKind::OnGrid ? "on-grid" : "held-out", correlation, summary_cell_m,
        std::sqrt(2.0 * correlation / (1.0 + correlation)));
  }
  return text;
}

/// How well two traced maps of a view agree, which bounds what can be shown of any method.
std::string truth_aim(const ResultsReport& report, const std::string& scene, ViewKind kind) {
  constexpr double least = 0.99;
  const ResultsRow* row = baseline_row(report.plan, report.rows, scene, kind);
  const ResultsCell* cell = row != nullptr ? row->at_cell(summary_cell_m) : nullptr;
  if (cell == nullptr) return {};
  const double correlation = cell->floor_median.correlation_db;
  return fmt::format("| {} | {} | *truth*, {} rays a cell | | {:.3f} | {:.2f} | {} | {:+.2f} | | |\n", scene,
                     text_of(kind), report.plan.traced_samples_of(kind), correlation, least,
                     correlation >= least ? "reached" : "missed", cell->floor_median.bias_db);
}

/// What was asked for at views that were baked, and what came out: of the grid as it is baked, and of the same looks
/// with as many rays as the truth has, on texels half as wide as well.
std::string aims_text(const ResultsReport& report) {
  const ResultsPlan& plan = report.plan;
  const auto mark = [](bool reached) { return reached ? "reached" : "missed"; };
  std::string text =
      "| scene | views | method | rays a texel | correlation of dB | aimed at | | bias [dB] | aimed at | |\n"
      "|---|---|---|---:|---:|---:|---|---:|---:|---|\n";
  for (const auto& [scene, least] : {std::pair(plan.scene_name(), 0.95), {std::string("level"), 0.99}}) {
    text += truth_aim(report, scene, ViewKind::OnGrid);
    for (const Method method : {Method::Paper, Method::LevelGround, Method::OwnGround}) {
      for (const auto& [grid, samples, change] :
           {std::tuple(plan.paper_grid().name(), plan.baked_samples, ""),
            {std::string(own_look), plan.finer_samples, ""},
            {std::string(own_look), plan.samples_of_finer_texels(), finer_texels_change}}) {
        const ResultsRow* row = find_row(report.rows, {.scene = scene,
                                                       .method = method,
                                                       .grid = grid,
                                                       .baked_samples = samples,
                                                       .kind = ViewKind::OnGrid,
                                                       .change = change});
        const ResultsCell* cell = row != nullptr ? row->at_cell(summary_cell_m) : nullptr;
        if (cell == nullptr) continue;
        const product::CellComparison& median = cell->median;
        const std::string name = text_of(method) + (row->of.change.empty() ? "" : ", " + row->of.change);
        text +=
            fmt::format("| {} | {} | {} | {} | {:.3f} | {:.2f} | {} | {:+.2f} | ±0.3 | {} |\n", scene,
                        text_of(ViewKind::OnGrid), name, samples, median.correlation_db, least,
                        mark(median.correlation_db >= least), median.bias_db, mark(std::abs(median.bias_db) <= 0.3));
      }
    }
  }
  text += truth_aim(report, plan.scene_name(), ViewKind::HeldOut);
  return "## What was aimed at\n\nAnd what came out at views that were baked, medians. Of views that were not, an aim "
         "is set for the truth alone.\n\n" +
         text + "\n";
}

std::string lead(const ResultsReport& report) {
  const ResultsPlan& plan = report.plan;
  const product::CompareOptions compare;
  std::string text = "# How close the baked map is\n\n";
  if (plan.scene_file.empty()) {
    text +=
        fmt::format("Ground maps of the paper's scene, made up, at scale {:g} ({:.0f} m a side), with {} materials",
                    plan.scale, plan.side_m(),
                    plan.materials == scene::PaperMaterials::Paper ? "the paper's" : "real buildings' (ITU-R P.2040)");
  } else {
    text +=
        plan.around_m == Vec2d{}
            ? fmt::format("Ground maps of the middle {:.0f} m of {}", plan.side_m(), report.scene)
            : fmt::format("Ground maps of {:.0f} m of {}, whose middle lies {:g} m east and {:g} m north of its own",
                          plan.side_m(), report.scene, plan.around_m.x, plan.around_m.y);
  }
  text += fmt::format(
      ", rendered from terrain and baked reflectivity and held against path-traced maps of the full scene. Made "
      "by {}:\n\n```\n{}\n```\n\n"
      "Numbers are medians over the views, in brackets the worst view. Sum of polarizations VV + HH + 2·HV; dB of σ0 "
      "no lower than {:g} dB; a cell is in shadow below {:g} dB. `product/map_metrics.h` defines the five numbers.\n\n"
      "The radar stands 20 km from the middle of the scene, resolution 2 m in range and across. A rim of {:.0f} m "
      "along the edges is left out: walls there mirror ground beyond the scene, which is there in a bake but not in a "
      "traced map.\n\n",
      product::software_name(), report.command_line, compare.floor_db, compare.shadow_db, plan.rim_m());
  text +=
      "- **paper**: the paper to the letter (docs/decisions/0050-the-paper-literally.md); its store is "
      "counted as the paper counts, four floats a texel and look\n"
      "- **ours, shadows baked**: echoes straight into texels, γ blended over cot ψ "
      "(docs/decisions/0005-blend-gamma.md), half floats, compressed\n"
      "- **ours, on level ground**: the ground apart from what stands on it, its shadows made at run time "
      "(docs/decisions/0006-ground-apart.md); its bytes include the ground\n"
      "- **ours, on its own ground**: objects baked on the terrain that they stand on as well "
      "(docs/decisions/0051-baked-on-its-own-ground.md); what `sigmascape bake` does by itself\n\n";
  if (plan.scene_file.empty()) {
    text +=
        "*hills* is the scene as it is; *level* the same with its ground at height zero, at views that were baked and "
        "from ten times as far away, where waves are as good as plane. What is baked on level ground serves both.\n\n";
  }
  if (!report.attribution.empty()) text += "Data: " + report.attribution + "\n\n";
  return text;
}

/// The figures of a section beside one another, at most three in a row; four in two rows of two.
std::string figures_text(const std::vector<product::PageSection>& sections, const std::string& attribution) {
  std::string text;
  for (const product::PageSection& section : sections) {
    text += "## " + section.heading + "\n\n";
    for (const std::string& paragraph : section.paragraphs) text += paragraph + "\n\n";
    const std::size_t in_a_row = section.figures.size() == 4 ? 2 : 3;
    for (std::size_t first = 0; first < section.figures.size(); first += in_a_row) {
      std::string captions = "|", rules = "|", pictures = "|";
      for (std::size_t i = first; i < std::min(first + in_a_row, section.figures.size()); ++i) {
        const product::PageFigure& figure = section.figures[i];
        captions += fmt::format(" {} |", figure.caption);
        rules += "---|";
        pictures += fmt::format(" ![{}]({}) |", figure.caption, figure.png.filename().string());
      }
      text += fmt::format("{}\n{}\n{}\n\n", captions, rules, pictures);
    }
    if (!attribution.empty()) text += "Data: " + attribution + "\n\n";
  }
  return text;
}

std::string settings_text(const ResultsPlan& plan) {
  return fmt::format(
             "## Settings\n\n"
             "- {} rays a texel of {:.2f} m; each method has a bake of its own, out of whose looks coarser grids are "
             "read too; {} rays where stated\n"
             "- {} rays a 2 m cell in each of the two traced maps of a view, {} where it was baked\n"
             "- {} bounces, seed {}, 10 GHz\n",
             plan.baked_samples, ResultsPlan::texel_m, plan.finer_samples, plan.traced_samples,
             plan.traced_samples_of(ViewKind::OnGrid), plan.bounces, plan.seed) +
         grid_list(plan) +
         "\nHeld-out views are drawn from the seed, azimuth evenly over the circle and elevation evenly over 3° to "
         "40°; the view of the paper's picture stands by itself.\n\n" +
         view_table(plan);
}

std::string causes_section(const ResultsReport& report) {
  std::string text = fmt::format(
      "## Why\n\nWhat the error is made of: each cause switched off alone, medians over the views at {:.0f} m cells. "
      "Causes are weighed against those that are measured at the same views alone; what is held against another truth "
      "stands in its table and is not weighed.\n\n",
      summary_cell_m);
  for (const ViewKind kind : {ViewKind::HeldOut, ViewKind::OnGrid}) {
    if (baseline_row(report.plan, report.rows, report.plan.scene_name(), kind) == nullptr) continue;
    text += fmt::format("### At views that were {}baked\n\n{}\n{}\n\n", kind == ViewKind::OnGrid ? "" : "not ",
                        causes_table(report.plan, report.rows, kind), largest_causes(report.plan, report.rows, kind));
  }
  return text;
}

std::string changes_section(const ResultsReport& report) {
  return fmt::format(
      "## Cheap wins\n\nEach change made alone to the method named beside it, held-out views at {:.0f} m cells. Frame "
      "times are milliseconds on the wall.\n\n{}\n{}\n\n{}",
      summary_cell_m, changes_table(report.plan, report.rows), worth_of_looks(report.plan, report.rows),
      combinations_section(report.plan, report.rows));
}

}  // namespace

std::string results_markdown(const ResultsReport& report) {
  const ResultsPlan& plan = report.plan;
  std::string text = lead(report) + fmt::format("## At {:.0f} m cells\n\n", summary_cell_m) + summary_table(report);
  text +=
      "\nThe rows *truth* hold one traced map against another that differs in its seed alone. Baked maps are held "
      "against the mean of the two, whose noise has half the variance of either's. " +
      ceiling_text(report) + elevation_remark(plan) + "Bake times are seconds of processor time.\n\n" +
      aims_text(report) + without_noise_section(report) + level_section(report);
  text += causes_section(report) + changes_section(report);
  for (const auto& [name, plot] : plots_of(report)) text += fmt::format("![{}]({})\n\n", plot.title, name);
  text += "## By cell size\n\nThe " + plan.paper_grid().name() + " grid.\n\n" + cell_table(report);
  text += "\n## By level of detail\n\nThe " + plan.paper_grid().name() +
          " grid, ours on its own ground. LOD 1 reads textures from their finest level, each next one from the "
          "level above; one store and one bake serve them all.\n\n" +
          level_table(report);
  text +=
      "\n## Bytes and time\n\nSeconds of processor time for the bake and for one traced map, milliseconds on the "
      "wall for a rendered one, by " +
      report.machine + ". Medians over the held-out views.\n\n" + time_table(report) + "\n" + vertices_text(report);
  return text + figures_text(report.figures, report.attribution) + settings_text(plan);
}

std::vector<product::PageSection> results_sections(const std::vector<ResultsRow>& rows) {
  std::vector<product::PageSection> sections;
  for (const ResultsRow& row : rows) {
    const ResultsCell* cell = row.at_cell(summary_cell_m);
    if (cell == nullptr) continue;
    const std::string heading =
        fmt::format("{}, {} at {:.0f} m cells: median (worst)", row.of.scene, text_of(row.of.kind), summary_cell_m);
    if (sections.empty() || sections.back().heading != heading) {
      sections.push_back({.heading = heading,
                          .paragraphs = {"Correlation of dB, RMS dB, bias in dB, relative L1, shadow IoU; store and "
                                         "processor time of the bake."}});
      sections.back().facts.push_back(
          {"truth against truth", metrics_text(cell->floor_median, cell->floor_worst, row.views)});
    }
    sections.back().facts.push_back(
        {fmt::format("{}{}{}, {}, {} rays, LOD {}", text_of(row.of.method), row.of.change.empty() ? "" : ", ",
                     row.of.change, row.of.grid, row.of.baked_samples, row.of.level_of_detail),
         fmt::format("{}; {} MB, {:.0f} s", metrics_text(cell->median, cell->worst, row.views),
                     megabytes(row.atlas.store_bytes), row.atlas.bake_seconds)});
  }
  return sections;
}

}  // namespace sigmascape::cli
