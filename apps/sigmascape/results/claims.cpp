#include "results/claims.h"

#include <fmt/format.h>

#include "results/columns.h"
#include "results/tracing.h"

namespace sigmascape::cli {
namespace {

/// The paper's method and ours on its own ground, from one grid at views of one kind.
struct BothMethods {
  const ResultsRow *paper, *ours;

  [[nodiscard]] bool are_measured() const { return summary_cell(paper) != nullptr && summary_cell(ours) != nullptr; }
};

BothMethods both_methods(const ResultsReport& report, const LookGrid& grid, ViewKind kind) {
  ResultsCase of{.scene = report.plan.scene_name(),
                 .method = Method::Paper,
                 .grid = grid.name(),
                 .baked_samples = report.plan.baked_samples,
                 .kind = kind};
  const ResultsRow* paper = find_row(report.rows, of);
  of.method = Method::OwnGround;
  return {paper, find_row(report.rows, of)};
}

std::string line(const char* claim, const std::string& found) {
  return fmt::format("| {} | {} |\n", claim, found);
}

/// How like a traced map are those of the view of the paper's picture.
std::string likeness(const ResultsReport& report) {
  const BothMethods from = both_methods(report, report.plan.paper_grid(), ViewKind::Paper);
  if (!from.are_measured()) return {};
  const product::CellComparison &its = summary_cell(from.paper)->median, &our = summary_cell(from.ours)->median,
                                &traced = summary_cell(from.paper)->floor_median;
  return line("\"very strong correlation between the output of the two methods\", by eye, in Figure 8",
              fmt::format(
                  "at that view the correlation of dB at {:.0f} m cells is {}, of ours {}, of two traced maps {}",
                  summary_cell_m, number_text(its.correlation_db, 3), number_text(our.correlation_db, 3),
                  number_text(traced.correlation_db, 3))) +
         line(
             "\"overall terrain patterns, especially those from building and terrain self-shadows, are highly "
             "correlated\"",
             fmt::format("there the shadow IoU is {}, of ours {}, of two traced maps {}",
                         number_text(its.shadow_iou, 2), number_text(our.shadow_iou, 2),
                         number_text(traced.shadow_iou, 2)));
}

/// Power, and what a map takes, at views that were not baked.
std::string power_and_speed(const ResultsReport& report, const BothMethods& from) {
  if (!from.are_measured()) return {};
  const auto bias = [](const ResultsRow* row) {
    const ResultsCell& cell = *summary_cell(row);
    return fmt::format("{} ({}) dB", signed_text(cell.median.bias_db, 2), signed_text(cell.worst.bias_db, 2));
  };
  return line("\"physically accurate, especially regarding the conservation of power\"",
              fmt::format("total power against the truth's at held-out views, median (worst): {}, of ours {}",
                          bias(from.paper), bias(from.ours))) +
         line("\"rendering time is reduced to the order of milliseconds\"",
              fmt::format("{:.0f} ms a map, ours {:.0f} ms", from.paper->render_ms, from.ours->render_ms)) +
         line("\"computed in only fractions of the time\"",
              "a map " + speed_at_equal_error(report.plan, report.rows, *from.paper));
}

/// What a look takes to bake, and a store of as many looks as the paper counts.
std::string looks_and_bytes(const ResultsReport& report) {
  const auto from = both_methods(report, report.plan.grids.front(), ViewKind::HeldOut);
  if (!from.are_measured()) return {};
  const auto seconds_a_look = [](const ResultsRow* row) {
    return row->atlas.bake_seconds / static_cast<double>(row->atlas.looks);
  };
  // The store grows as the area does.
  const auto at_full_size_mb = [&](const ResultsRow* row) {
    return static_cast<double>(row->atlas.store_bytes) / 1e6 / (report.plan.scale * report.plan.scale);
  };
  return line("\"approximately 5 seconds\" for each look, on an NVIDIA RTX A3000",
              fmt::format("{} s for {:.0f} m a side, ours {} s", two_digits(seconds_a_look(from.paper)),
                          report.plan.side_m(), two_digits(seconds_a_look(from.ours)))) +
         line("\"32 1024 × 1024, 4 channel floating point textures (537 MB)\"",
              fmt::format(
                  "{} looks, {}, take {:.0f} MB on the 2 km of the paper, ours {:.0f} MB, from {} and {} MB here "
                  "(the five elevations that the paper names would be 40 looks)",
                  from.paper->atlas.looks, from.paper->of.grid, at_full_size_mb(from.paper), at_full_size_mb(from.ours),
                  megabytes(from.paper->atlas.store_bytes), megabytes(from.ours->atlas.store_bytes)));
}

std::string vertices(const VertexCounts& counts) {
  const std::size_t all = counts.terrain + counts.objects;
  if (all == 0) return {};
  return line("\"around 0.16% of the number of vertices and triangles\"",
              fmt::format("{} % of the vertices",
                          two_digits(100.0 * static_cast<double>(counts.terrain) / static_cast<double>(all))));
}

}  // namespace

std::string claims_section(const ResultsReport& report) {
  const ResultsPlan& plan = report.plan;
  const BothMethods from = both_methods(report, plan.paper_grid(), ViewKind::HeldOut);
  if (!plan.is_the_papers_scene() || !from.are_measured()) return {};
  return fmt::format(
             "## What the paper says\n\nBeside it what is measured here of its method, from {} looks where nothing "
             "else is said, and of ours on its own ground; times are of processors, on {:.0f} m a side, the paper's of "
             "a "
             "graphics card, on 2 km.\n\n| the paper says | measured here |\n|---|---|\n",
             plan.paper_grid().name(), plan.side_m()) +
         likeness(report) + power_and_speed(report, from) + looks_and_bytes(report) + vertices(report.vertices) + "\n";
}

}  // namespace sigmascape::cli
