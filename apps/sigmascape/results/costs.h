#pragma once

#include <string>

#include "results/page.h"

namespace sigmascape::cli {

/// Whether a row is of a whole grid, baked and rendered as the plan has it.
[[nodiscard]] bool is_plain(const ResultsRow& row, const ResultsPlan& plan);

/// Markdown: bytes and times of every method and grid, and the vertices that maps from textures can do without.
[[nodiscard]] std::string costs_section(const ResultsReport& report);

}  // namespace sigmascape::cli
