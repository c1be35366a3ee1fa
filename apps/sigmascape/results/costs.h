#pragma once

#include <string>

#include "results/page.h"

namespace sigmascape::cli {

/// Whether something is rendered in full detail from a whole grid, whatever is changed of the method, with the plan's
/// rays or with rays where the noise is.
[[nodiscard]] bool is_from_a_grid(const ResultsCase& of, const ResultsPlan& plan);

/// Whether a row is of a whole grid, baked as the plan has it or with rays where the noise is, and rendered as it is.
[[nodiscard]] bool is_of_a_grid(const ResultsRow& row, const ResultsPlan& plan);

/// Markdown: bytes and times of every method and grid, and the vertices that maps from textures can do without.
[[nodiscard]] std::string costs_section(const ResultsReport& report);

}  // namespace sigmascape::cli
