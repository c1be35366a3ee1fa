#pragma once

#include <string>

#include "results/page.h"

namespace sigmascape::cli {

/// Markdown: what the paper says of its method, and what this page measures of it, side by side; empty of another scene
/// than the paper's. A claim that nothing was measured for is left out.
[[nodiscard]] std::string claims_section(const ResultsReport& report);

}  // namespace sigmascape::cli
