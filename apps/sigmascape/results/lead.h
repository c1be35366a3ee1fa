#pragma once

#include <string>

#include "results/page.h"

namespace sigmascape::cli {

/// Markdown: what the page is about, what was found, and the words that it uses.
[[nodiscard]] std::string results_lead(const ResultsReport& report);

/// Markdown: what was held against what, and how the tables are to be read.
[[nodiscard]] std::string how_it_was_measured(const ResultsReport& report);

}  // namespace sigmascape::cli
