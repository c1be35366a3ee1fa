#pragma once

#include <string>
#include <vector>

#include "results_table.h"

#include "sigmascape/product/comparison_page.h"

namespace sigmascape::cli {

/// The measurement as a Markdown page. Besides the times it depends on the plan alone, not on machine or day.
[[nodiscard]] std::string results_markdown(const ResultsPlan& plan, const std::vector<ResultsRow>& rows);

/// The measurement's numbers as sections of a page with pictures.
[[nodiscard]] std::vector<product::PageSection> results_sections(const std::vector<ResultsRow>& rows);

/// What separates the baked maps from the truth, in a sentence, from the numbers.
[[nodiscard]] std::string what_limits(const ResultsPlan& plan, const std::vector<ResultsRow>& rows);

}  // namespace sigmascape::cli
