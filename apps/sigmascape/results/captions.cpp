#include "results/captions.h"

#include <algorithm>
#include <fmt/format.h>

#include "results/columns.h"

namespace sigmascape::cli {

const ViewResult* find_view(const std::vector<ViewResult>& views, const ResultsPlan& plan, const PlannedView& view,
                            Method method, const std::string& grid) {
  const ResultsCase wanted{.scene = plan.scene_name(),
                           .method = method,
                           .grid = grid,
                           .baked_samples = plan.baked_samples,
                           .kind = view.kind};
  const auto found = std::ranges::find_if(views, [&](const ViewResult& result) {
    return result.of == wanted && result.view.azimuth_deg == view.azimuth_deg &&
           result.view.elevation_deg == view.elevation_deg;
  });
  return found == views.end() ? nullptr : &*found;
}

std::string caption_of(const ViewResult& map) {
  std::string text = fmt::format("{}, {}: ", text_of(map.of.method), map.of.grid);
  if (const product::CellComparison* cell = map.comparison.at_cell(summary_cell_m)) {
    const product::CellComparison* floor = map.noise_floor.at_cell(summary_cell_m);
    text +=
        fmt::format("correlation {}, {} dB RMS at {:.0f} m cells{}; ", number_text(cell->correlation_db, 3),
                    number_text(cell->rms_db, 2), summary_cell_m,
                    floor != nullptr ? fmt::format(" (two traced maps: {} dB)", number_text(floor->rms_db, 2)) : "");
  }
  return text + fmt::format("{:.2f} s, {} MB stored, {} MB in memory", map.render_ms / 1e3,
                            megabytes(map.atlas.store_bytes), megabytes(map.atlas.memory_bytes));
}

std::string traced_caption(const ViewResult& any_map, std::size_t tracing_memory_bytes) {
  return fmt::format(
      "Path-traced from the full scene, the mean of two maps: {:.1f} s for each of {} rays a cell, {} MB of "
      "acceleration structures in memory",
      any_map.trace_seconds, any_map.view.traced_samples, megabytes(tracing_memory_bytes));
}

}  // namespace sigmascape::cli
