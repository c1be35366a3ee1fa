#pragma once

#include "made_rows.h"
#include "results/page.h"

namespace sigmascape::cli {

/// A report of made numbers: the paper's method and ours at views of both kinds, from two grids each.
inline ResultsReport made_report(bool is_a_place) {
  ResultsReport report{.plan = made_plan(),
                       .scene = "Harbour",
                       .attribution = {},
                       .machine = "a machine",
                       .command_line = "sigmascape results",
                       .links = PageLinks("docs/results/itu/README.md"),
                       .vertices = {.terrain = 100, .objects = 900},
                       .tracing_memory_bytes = 1'000'000,
                       .patches = 4,
                       .views = {},
                       .rows = {},
                       .figures = {{.heading = "Figures 5 and 6: the scene", .figures = {{"a.png", "above"}}}}};
  if (is_a_place) report.plan.scene_file = "harbour.toml";
  for (const ViewKind kind : {ViewKind::OnGrid, ViewKind::HeldOut}) {
    for (const Method method : {Method::Paper, Method::OwnGround}) {
      ResultsCase of = made_case(report.plan, method, kind);
      // What two grids both hold comes out the same, what only one holds does not.
      const double rms_db = method == Method::Paper ? 8.0 : 5.0;
      of.grid = report.plan.grids.front().name();
      report.rows.push_back(made_row(of, kind == ViewKind::OnGrid ? rms_db : rms_db + 1.0, 0.5, 1'000'000));
      of.grid = report.plan.paper_grid().name();
      report.rows.push_back(made_row(of, rms_db, 0.5, 2'000'000));
    }
  }
  return report;
}

}  // namespace sigmascape::cli
