#pragma once

#include <filesystem>
#include <vector>

#include "results/plan.h"
#include "results/results_pages.h"
#include "results/table.h"

namespace sigmascape::cli {

/// A page in a folder beside that of the paper's scene.
struct Neighbour {
  ResultsPage page;
  std::vector<ResultsRow> rows;  ///< none where nothing that can be read was measured
};

/// The pages beside `page` that have a measured.json of today's form, and those that have none, in the order of
/// results_pages; none at all where no page has, where `page` is empty, and of another scene than the paper's.
[[nodiscard]] std::vector<Neighbour> neighbours_of(const std::filesystem::path& page, const ResultsPlan& plan);

}  // namespace sigmascape::cli
