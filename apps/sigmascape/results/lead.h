#pragma once

#include <string>

#include "results/page.h"

namespace sigmascape::cli {

/// Markdown: what was found, and what the page is about.
[[nodiscard]] std::string results_lead(const ResultsReport& report);

/// Markdown: the words that the page uses.
[[nodiscard]] std::string words_section(const ResultsReport& report);

/// Markdown: what was held against what, and how the tables are to be read.
[[nodiscard]] std::string how_it_was_measured(const ResultsReport& report);

}  // namespace sigmascape::cli
