#pragma once

#include <string>

#include "results/page.h"

namespace sigmascape::cli {

/// Whether a row is of a whole grid, baked as the plan has it or with rays where the noise is, and rendered as it is.
[[nodiscard]] bool is_of_a_grid(const ResultsRow& row, const ResultsPlan& plan);

/// Markdown: bytes and times of every method and grid, and the vertices that maps from textures can do without.
[[nodiscard]] std::string costs_section(const ResultsReport& report);

}  // namespace sigmascape::cli
