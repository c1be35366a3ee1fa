#pragma once

#include <string>
#include <vector>

#include "results/plan.h"
#include "results/table.h"

namespace sigmascape::cli {

/// Markdown: what path-traced maps of few rays differ from the truth by, beside rendered ones, and what either takes;
/// empty where none was measured.
[[nodiscard]] std::string tracing_section(const ResultsPlan& plan, const std::vector<ResultsRow>& rows);

}  // namespace sigmascape::cli
