#pragma once

#include <string>
#include <vector>

#include "results/plan.h"
#include "results/table.h"

namespace sigmascape::cli {

/// Markdown: what path-traced maps of few rays differ from the truth by, beside rendered ones, and what either takes;
/// empty where none was measured. How many times as long tracing to the same error takes, and from how many maps on a
/// bake pays, is told only where a traced map of fewer rays was measured and does not come as close: where the fewest
/// that were traced are enough, fewer might be.
[[nodiscard]] std::string tracing_section(const ResultsPlan& plan, const std::vector<ResultsRow>& rows);

/// A sentence: what a map made in that way takes, and a path-traced one that comes as close; of the map alone where
/// none was traced.
[[nodiscard]] std::string speed_at_equal_error(const ResultsPlan& plan, const std::vector<ResultsRow>& rows,
                                               const ResultsRow& way);

}  // namespace sigmascape::cli
