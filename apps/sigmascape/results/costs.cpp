#include "results/costs.h"

#include <fmt/format.h>

#include "results/columns.h"

namespace sigmascape::cli {
namespace {

std::string cost_table(const ResultsReport& report, const TracedRays& rays) {
  std::string text =
      "| method | looks | number of looks | store [MB] | in memory [MB] | bake [s] | bake of a look [s] | one map [s] "
      "|\n|---|---|---:|---:|---:|---:|---:|---:|\n";
  const ResultsRow* traced = baseline_row(report.plan, report.rows, report.plan.scene_name(), ViewKind::HeldOut);
  if (traced != nullptr) {
    text += fmt::format("| *path-traced*, {} rays a cell | | | | {} | | | {:.1f} |\n", rays.fewest,
                        megabytes(report.tracing_memory_bytes), traced->trace_seconds);
  }
  for (const ResultsRow& row : report.rows) {
    if (row.of.scene != report.plan.scene_name() || row.of.kind != ViewKind::HeldOut || !is_of_a_grid(row, report.plan))
      continue;
    text += fmt::format("| {} | {} | {} | {} | {} | {:.0f} | {:.1f} | {:.3f} |\n", way_text(row.of), row.of.grid,
                        row.atlas.looks, megabytes(row.atlas.store_bytes), megabytes(row.atlas.memory_bytes),
                        row.atlas.bake_seconds, row.atlas.bake_seconds / static_cast<double>(row.atlas.looks),
                        row.render_ms / 1e3);
  }
  return text;
}

/// Where the square lies on several patches their bakes are dearer than one of the square.
std::string patches_text(const ResultsReport& report) {
  if (report.patches < 2) return {};
  return fmt::format(
      "Times of bakes are not of the same area: the square lies on {} patches of {:.0f} m, and ours bakes each by "
      "itself, with all around it that lies over or echoes into it, as it bakes landscapes of any size; the paper's "
      "method bakes the square at once.\n\n",
      report.patches, report.plan.bake_settings(Method::OwnGround).patches.side_m());
}

std::string vertices_text(const ResultsReport& report) {
  const auto [terrain, objects] = report.vertices;
  const auto all = static_cast<double>(terrain + objects);
  return fmt::format(
      "Vertices kept: the scene has {} within the square, where every tree counts with its own; a rendered map knows "
      "the {} of its terrain, {:.3g} % of them (the paper: 0.16 %). Path tracing keeps each kind of tree once, however "
      "often it stands: so its acceleration structures take no more than {} MB{}.\n\n",
      terrain + objects, terrain, 100.0 * static_cast<double>(terrain) / all, megabytes(report.tracing_memory_bytes),
      report.plan.scene_file.empty() ? "" : ", what stands beyond the square included");
}

}  // namespace

bool is_from_a_grid(const ResultsCase& of, const ResultsPlan& plan) {
  const bool has_rays_of_grids = of.baked_samples == plan.baked_samples || of.change == adaptive_change;
  return has_rays_of_grids && of.method != Method::Traced && of.grid != own_look && of.level_of_detail == 1;
}

bool is_of_a_grid(const ResultsRow& row, const ResultsPlan& plan) {
  return is_from_a_grid(row.of, plan) && (row.of.change.empty() || row.of.change == adaptive_change);
}

std::string costs_section(const ResultsReport& report) {
  const ResultsPlan& plan = report.plan;
  const TracedRays rays = traced_rays(plan, report.rows, plan.scene_name(), ViewKind::HeldOut);
  return fmt::format(
             "## Bytes and time\n\nMedians over the held-out views, processor time on {}; {} rays a texel, {} rays a "
             "2 m cell of one traced map{}. The store is what a map reads from disk, of ours compressed; the standard "
             "errors beside it, about a fifth more, are "
             "not counted. In memory are textures "
             "with their mips, as far as they lie within the {:.0f} m that are mapped (an atlas is loaded by whole "
             "patches, which reach beyond), and, to trace, the scene's acceleration structures.\n\n",
             report.machine, plan.baked_samples, rays.fewest,
             rays.most > rays.fewest ? ", in proportion where a view has more" : "", plan.side_m()) +
         cost_table(report, rays) + "\n" + patches_text(report) + vertices_text(report);
}

}  // namespace sigmascape::cli
