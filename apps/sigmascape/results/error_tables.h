#pragma once

#include <cstdint>
#include <string>

#include "results/page.h"

namespace sigmascape::cli {

/// Markdown: every scene, kind of view, method and nested grid at 8 m cells. Grids of a method that all its numbers
/// are the same from, as at views that both hold, share a row.
[[nodiscard]] std::string summary_section(const ResultsReport& report);

/// Markdown: what was asked for at views that were baked, and what came out.
[[nodiscard]] std::string aims_section(const ResultsReport& report);

/// Markdown: the paper's grid at every size of cells, and folded away every grid.
[[nodiscard]] std::string cell_section(const ResultsReport& report);

/// Rays a texel: a number, or, for none, what decides about it.
[[nodiscard]] std::string rays_text(std::uint32_t samples);

/// Markdown: the same of ours by level of detail.
[[nodiscard]] std::string detail_section(const ResultsReport& report);

}  // namespace sigmascape::cli
