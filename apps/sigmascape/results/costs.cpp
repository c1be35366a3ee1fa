#include "results/costs.h"

#include <fmt/format.h>

#include "results/columns.h"

namespace sigmascape::cli {
namespace {

std::string cost_table(const ResultsReport& report) {
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
  const auto [terrain, objects] = report.vertices;
  const auto all = static_cast<double>(terrain + objects);
  return fmt::format(
      "The scene has {} vertices within the square, each tree with its own; a rendered map knows the {} "
      "nodes of its terrain, {:.3g} % of them. To be traced, the whole scene takes {} MB of acceleration "
      "structures{}.\n\n",
      terrain + objects, terrain, 100.0 * static_cast<double>(terrain) / all, megabytes(report.tracing_memory_bytes),
      report.plan.scene_file.empty() ? "" : ", what stands beyond the square included");
}

}  // namespace

bool is_plain(const ResultsRow& row, const ResultsPlan& plan) {
  return row.of.change.empty() && row.of.level_of_detail == 1 && row.of.grid != own_look &&
         row.of.baked_samples == plan.baked_samples;
}

std::string costs_section(const ResultsReport& report) {
  const ResultsPlan& plan = report.plan;
  const TracedRays rays = traced_rays(plan, report.rows, plan.scene_name(), ViewKind::HeldOut);
  return fmt::format(
             "## Bytes and time\n\nMedians over the held-out views, processor time of {}; {} rays a texel, one traced "
             "map of {} rays a 2 m cell{}. The store is compressed. In memory, textures with their mips are counted as "
             "far as they lie "
             "within the {:.0f} m that are mapped: an atlas is loaded by whole patches, whose rest is of what lies "
             "around.\n\n",
             report.machine, plan.baked_samples, rays.fewest,
             rays.most > rays.fewest ? ", in proportion where a view has more" : "", plan.side_m()) +
         cost_table(report) + "\n" + vertices_text(report);
}

}  // namespace sigmascape::cli
