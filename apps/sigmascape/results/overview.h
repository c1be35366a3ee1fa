#pragma once

#include <string>

#include "results/page.h"

namespace sigmascape::cli {

/// Markdown: how far the paper's method and ours are from traced maps on every scene that has a page, this one and its
/// neighbours; empty without neighbours.
[[nodiscard]] std::string overview_section(const ResultsReport& report);

}  // namespace sigmascape::cli
