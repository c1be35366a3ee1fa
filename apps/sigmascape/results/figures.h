#pragma once

#include <filesystem>
#include <vector>

#include "results/measurement.h"

#include "sigmascape/product/comparison_page.h"

namespace sigmascape::cli {

/// Figures 1 and 5 to 8 of the paper from our own program, and the view that the paper's method does worst on: writes
/// the pictures into `folder` as PNG and gives them by sections.
[[nodiscard]] std::vector<product::PageSection> paper_figures(const Measurement& measurement, const ResultsPlan& plan,
                                                              const std::filesystem::path& folder);

}  // namespace sigmascape::cli
