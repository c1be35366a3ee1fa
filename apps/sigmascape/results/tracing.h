#pragma once

#include <string>
#include <vector>

#include "results/plan.h"
#include "results/table.h"

namespace sigmascape::cli {

/// Markdown: what path-traced maps of few rays differ from the truth by, beside rendered ones, and what either takes;
/// empty where none was measured. How many times as long tracing to the same error takes, and from how many maps on a
/// bake pays, lies between two traced maps, one not as close and one closer; nothing is told of it where the fewest
/// rays that were traced are enough, since fewer might be.
[[nodiscard]] std::string tracing_section(const ResultsPlan& plan, const std::vector<ResultsRow>& rows);

/// "takes 0.36 s of processor time, …": what a map made in that way takes, and a path-traced one that comes as close;
/// of the map alone where none was traced.
[[nodiscard]] std::string speed_at_equal_error(const ResultsPlan& plan, const std::vector<ResultsRow>& rows,
                                               const ResultsRow& way);

}  // namespace sigmascape::cli
