#pragma once

#include "results/causes.h"

namespace sigmascape::cli {

inline ResultsPlan made_plan() {
  ResultsOptions options;
  options.small = true;
  options.baked_samples = 4;
  options.finer_samples = 64;
  return results_plan(options);
}

/// A row of made numbers at the cells that verdicts are about.
inline ResultsRow made_row(const ResultsCase& of, double rms_db, double l1, std::uintmax_t bytes = 1000) {
  ResultsRow row;
  row.of = of;
  row.views = 4;
  row.rays = {1024, 6144};
  row.atlas.store_bytes = bytes;
  const product::CellComparison cell{
      .cell_m = summary_cell_m, .correlation_db = 0.9, .rms_db = rms_db, .l1 = l1, .shadow_iou = 0.5};
  product::CellComparison floor = cell;
  floor.rms_db = 2.0;
  row.cells = {{cell, cell, floor, floor, row.views}};
  for (std::size_t view = 0; view < row.views; ++view)
    row.at_views.push_back({.azimuth_deg = 10.0 * static_cast<double>(view), .elevation_deg = 20.0, .tested = cell});
  return row;
}

inline ResultsCase made_case(const ResultsPlan& plan, Method method, ViewKind kind) {
  return {.scene = plan.scene_name(),
          .method = method,
          .grid = plan.paper_grid().name(),
          .baked_samples = plan.baked_samples,
          .kind = kind};
}

}  // namespace sigmascape::cli
