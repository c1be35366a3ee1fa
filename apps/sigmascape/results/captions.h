#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "results/table.h"

namespace sigmascape::cli {

/// The whole grid of a method at one view, as the plan has it; nullptr where it was not measured.
[[nodiscard]] const ViewResult* find_view(const std::vector<ViewResult>& views, const ResultsPlan& plan,
                                          const PlannedView& view, Method method, const std::string& grid);

/// Of a map from textures: the method and its looks, how close it comes at summary_cell_m beside what two traced maps
/// of the view differ by, the processor time that it takes, and its bytes.
[[nodiscard]] std::string caption_of(const ViewResult& map);

/// Of the path-traced map that the others of its view are held against: the rays of one, its processor time, and the
/// memory of its acceleration structures.
[[nodiscard]] std::string traced_caption(const ViewResult& any_map, std::size_t tracing_memory_bytes);

}  // namespace sigmascape::cli
