#include "results_page.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <optional>

namespace sigmascape::cli {
namespace {

constexpr double summary_cell_m = 8.0;
const std::string paper_grid = "8 × 5";

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

/// One step on the way from the truth to what a user gets.
struct Rung {
  std::string name;
  std::string cause;  ///< what this step adds to the error
  ResultsCase of;
};

std::vector<Rung> ladder(const ResultsPlan& plan) {
  const std::string finest = plan.grids.back().name();
  const std::uint32_t samples = plan.baked_samples;
  return {{fmt::format("level ground, the view's own look alone, {} rays a texel", plan.finer_samples),
           "what textures keep of the scene and how they are laid out again",
           {"level", "look alone", plan.finer_samples, 1, ViewKind::OnGrid}},
          {fmt::format("the same, {} rays a texel", samples),
           "noise of the bake",
           {"level", "look alone", samples, 1, ViewKind::OnGrid}},
          {"the same from the " + paper_grid + " grid",
           "neighbouring looks blended in towards the edges of the map",
           {"level", paper_grid, samples, 1, ViewKind::OnGrid}},
          {"the same on hills",
           "textures of level ground laid over hills",
           {"hills", paper_grid, samples, 1, ViewKind::OnGrid}},
          {"held-out views on hills, " + finest + " grid",
           "views between the baked looks",
           {"hills", finest, samples, 1, ViewKind::HeldOut}},
          {"the same from the " + paper_grid + " grid",
           "fewer looks",
           {"hills", paper_grid, samples, 1, ViewKind::HeldOut}}};
}

std::string ladder_table(const ResultsPlan& plan, const std::vector<ResultsRow>& rows) {
  std::string text = fmt::format("| maps | adds | {} |\n|---|---|{}|\n", metric_heads, metric_rules);
  bool floor_shown = false;
  for (const Rung& rung : ladder(plan)) {
    const ResultsRow* row = find_row(rows, rung.of);
    const ResultsCell* cell = row != nullptr ? row->at_cell(summary_cell_m) : nullptr;
    if (cell == nullptr) continue;
    if (!floor_shown) {
      text += fmt::format("| truth against truth, level ground | noise of the truth | {} |\n",
                          metrics_text(cell->floor_median, cell->floor_worst, row->views));
      floor_shown = true;
    }
    text +=
        fmt::format("| {} | {} | {} |\n", rung.name, rung.cause, metrics_text(cell->median, cell->worst, row->views));
  }
  return text;
}

std::string summary_table(const ResultsPlan& plan, const std::vector<ResultsRow>& rows) {
  std::string text = fmt::format("| scene | views | grid | {} | store [MB] | bake [s] |\n|---|---|---|{}|---:|---:|\n",
                                 metric_heads, metric_rules);
  std::string last;
  for (const ResultsRow& row : rows) {
    const ResultsCell* cell = row.at_cell(summary_cell_m);
    if (cell == nullptr || row.of.level_of_detail != 1 || row.of.grid == "look alone") continue;
    if (row.of.baked_samples != plan.baked_samples) continue;
    const std::string group = row.of.scene + text_of(row.of.kind);
    if (group != last) {
      text += fmt::format("| {} | {} ({}) | *truth* | {} | | |\n", row.of.scene, text_of(row.of.kind), row.views,
                          metrics_text(cell->floor_median, cell->floor_worst, row.views));
    }
    last = group;
    text += fmt::format("| {} | {} ({}) | {} | {} | {} | {:.0f} |\n", row.of.scene, text_of(row.of.kind), row.views,
                        row.of.grid, metrics_text(cell->median, cell->worst, row.views),
                        megabytes(row.atlas.store_bytes), row.atlas.bake_seconds);
  }
  return text;
}

std::string cell_table(const ResultsPlan& plan, const std::vector<ResultsRow>& rows) {
  std::string text =
      fmt::format("| scene | views | cell [m] | {} | truth: correlation, RMS [dB], IoU |\n|---|---|---:|{}|---|\n",
                  metric_heads, metric_rules);
  for (const char* scene : {"hills", "level"}) {
    for (const ViewKind kind : {ViewKind::OnGrid, ViewKind::HeldOut, ViewKind::Paper}) {
      const ResultsRow* row = find_row(rows, {scene, paper_grid, plan.baked_samples, 1, kind});
      if (row == nullptr) continue;
      for (const ResultsCell& cell : row->cells) {
        text += fmt::format("| {} | {} | {:.0f} | {} | {:.3f}, {:.2f}, {:.2f} |\n", scene, text_of(kind),
                            cell.median.cell_m, metrics_text(cell.median, cell.worst, row->views),
                            cell.floor_median.correlation_db, cell.floor_median.rms_db, cell.floor_median.shadow_iou);
      }
    }
  }
  return text;
}

std::string level_table(const ResultsPlan& plan, const std::vector<ResultsRow>& rows) {
  std::string text = fmt::format("| LOD | views | cell [m] | {} |\n|---:|---|---:|{}|\n", metric_heads, metric_rules);
  for (const ViewKind kind : {ViewKind::OnGrid, ViewKind::HeldOut}) {
    for (int level = 1; level <= 3; ++level) {
      const ResultsRow* row = find_row(rows, {"hills", paper_grid, plan.baked_samples, level, kind});
      if (row == nullptr) continue;
      for (const double cell_m : {2.0, 8.0, 32.0}) {
        const ResultsCell* cell = row->at_cell(cell_m);
        if (cell == nullptr) continue;
        text += fmt::format("| {} | {} | {:.0f} | {} |\n", level, text_of(kind), cell_m,
                            metrics_text(cell->median, cell->worst, row->views));
      }
    }
  }
  return text;
}

std::string time_table(const ResultsPlan& plan, const std::vector<ResultsRow>& rows) {
  std::string text =
      "| grid | looks | store [MB] | in memory [MB] | bake [s] | render [ms] | trace [s] |\n"
      "|---|---:|---:|---:|---:|---:|---:|\n";
  for (const LookGrid& grid : plan.grids) {
    const ResultsRow* row = find_row(rows, {"hills", grid.name(), plan.baked_samples, 1, ViewKind::HeldOut});
    if (row == nullptr) continue;
    text += fmt::format("| {} | {} | {} | {} | {:.0f} | {:.0f} | {:.1f} |\n", grid.name(), row->atlas.looks,
                        megabytes(row->atlas.store_bytes), megabytes(row->atlas.memory_bytes), row->atlas.bake_seconds,
                        row->render_ms, row->trace_seconds);
  }
  return text;
}

std::string view_table(const ResultsPlan& plan) {
  std::string text = "| view | azimuth [°] | elevation [°] |\n|---|---:|---:|\n";
  for (const PlannedView& view : plan.views)
    text += fmt::format("| {} | {:.1f} | {:.1f} |\n", text_of(view.kind), view.azimuth_deg, view.elevation_deg);
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
  for (const LookGrid& grid : plan.grids)
    text += fmt::format("- {}: azimuths every {:g}°, elevations {}°\n", grid.name(), 360.0 / grid.azimuths,
                        fmt::join(grid.elevations_deg, "°, "));
  return text;
}

/// How well two traced maps agree, and what that leaves a baked map to reach: with the noise of both alike and
/// independent, a map without any correlates with their mean by √(2ρ / (1 + ρ)) of their own correlation ρ.
std::string ceiling_text(const ResultsPlan& plan, const std::vector<ResultsRow>& rows) {
  std::string text;
  for (const ViewKind kind : {ViewKind::OnGrid, ViewKind::HeldOut}) {
    const ResultsRow* row = find_row(rows, {"hills", paper_grid, plan.baked_samples, 1, kind});
    const ResultsCell* cell = row != nullptr ? row->at_cell(summary_cell_m) : nullptr;
    if (cell == nullptr) continue;
    const double correlation = cell->floor_median.correlation_db;
    text += fmt::format(
        "Two traced maps of one {} view on hills correlate by {:.3f} at {:.0f} m cells, so that a baked map without "
        "fault would reach about {:.3f} against their mean. ",
        kind == ViewKind::OnGrid ? "on-grid" : "held-out", correlation, summary_cell_m,
        std::sqrt(2.0 * correlation / (1.0 + correlation)));
  }
  return text;
}

}  // namespace

std::string what_limits(const ResultsPlan& plan, const std::vector<ResultsRow>& rows) {
  std::string cause;
  double largest_step = 0.0, from = 0.0, to = 0.0;
  std::optional<double> before;
  for (const Rung& rung : ladder(plan)) {
    const ResultsRow* row = find_row(rows, rung.of);
    const ResultsCell* cell = row != nullptr ? row->at_cell(summary_cell_m) : nullptr;
    if (cell == nullptr) continue;
    const double here = cell->median.l1, last = before.value_or(cell->floor_median.l1);
    if (here - last > largest_step) {
      largest_step = here - last;
      cause = rung.cause;
      from = last;
      to = here;
    }
    before = here;
  }
  if (cause.empty()) return "No step adds error.";
  return fmt::format("By relative L1 at {:.0f} m cells the largest step is: {} ({:.2f} to {:.2f}).", summary_cell_m,
                     cause, from, to);
}

std::string results_markdown(const ResultsPlan& plan, const std::vector<ResultsRow>& rows) {
  const product::CompareOptions compare;
  const std::string lead = fmt::format(
      "# How close the baked map is\n\n"
      "Ground maps of the paper's scene at scale {:g} ({:.0f} m a side), rendered from terrain and baked reflectivity, "
      "held against path-traced maps of the full scene. The program writes this page: `sigmascape results --help`.\n\n"
      "Numbers are medians over the views, in brackets the worst view. Sum of polarizations VV + HH + 2·HV; dB of σ0 "
      "no "
      "lower than {:g} dB; a cell is in shadow below {:g} dB. `product/map_metrics.h` defines the five numbers.\n\n"
      "*hills* is the scene as it is; *level* the same with its ground at height zero. Textures are baked on level "
      "ground, so one store serves both. The radar stands 20 km from the middle of the scene, resolution 2 m in range "
      "and across. A rim of {:.0f} m along the edges is left out: walls there mirror ground beyond the scene, which is "
      "there "
      "in a bake but not in a traced map.\n\n",
      plan.scale, 2000.0 * plan.scale, compare.floor_db, compare.shadow_db, plan.rim_m());
  const std::string settings = fmt::format(
      "\n## Settings\n\n"
      "- {} rays a texel of {:.2f} m in the store, out of which coarser grids are read too; {} where stated\n"
      "- {} rays a 2 m cell in each of the two traced maps of a view\n"
      "- {} bounces, seed {}, 10 GHz, the paper's materials\n",
      plan.baked_samples, plan.bake_settings().patches.texel_m, plan.finer_samples, plan.traced_samples, plan.bounces,
      plan.seed);
  return lead + fmt::format("## At {:.0f} m cells\n\n", summary_cell_m) + summary_table(plan, rows) +
         "\nThe rows *truth* hold one traced map against another that differs in its seed alone. Baked maps are held "
         "against the mean of the two, whose noise has half the variance of either's. " +
         ceiling_text(plan, rows) + elevation_remark(plan) +
         "Bake times are seconds of processor time.\n\n"
         "## What limits it\n\n"
         "From the best case to the usual one, one thing after another, at " +
         fmt::format("{:.0f} m cells:\n\n", summary_cell_m) + ladder_table(plan, rows) + "\n" +
         what_limits(plan, rows) +
         " Held-out views are other views than those on the grid, so the step between them holds the difference of the "
         "views as well.\n\n"
         "## By cell size\n\nThe " +
         paper_grid + " grid.\n\n" + cell_table(plan, rows) + "\n## By level of detail\n\nThe " + paper_grid +
         " grid on hills. LOD 1 reads textures from their finest level, each next one from the level above.\n\n" +
         level_table(plan, rows) +
         "\n## Bytes and time\n\nSeconds of processor time for the bake and for one traced map, milliseconds on the "
         "wall "
         "for a rendered one: these depend on the machine. Medians over the held-out views on hills.\n\n" +
         time_table(plan, rows) + settings + grid_list(plan) +
         "\nHeld-out views are drawn from the seed, azimuth evenly over the circle and elevation evenly over 3° to "
         "40°; "
         "the view of the paper's picture stands by itself.\n\n" +
         view_table(plan);
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
        {fmt::format("{}, {} rays, LOD {}", row.of.grid, row.of.baked_samples, row.of.level_of_detail),
         fmt::format("{}; {} MB, {:.0f} s", metrics_text(cell->median, cell->worst, row.views),
                     megabytes(row.atlas.store_bytes), row.atlas.bake_seconds)});
  }
  return sections;
}

}  // namespace sigmascape::cli
