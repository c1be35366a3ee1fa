#pragma once

#include <optional>
#include <string>
#include <vector>

#include "results/plan.h"
#include "results/table.h"

namespace sigmascape::cli {

/// Two cases that differ in one thing alone.
struct Contrast {
  std::string name;
  std::string how;  ///< the case with it against the case without it, in words
  ResultsCase with, without;
};

/// The measurements of a contrast, at the cells that verdicts are about.
struct MeasuredContrast {
  const ResultsRow *with, *without;
  const ResultsCell *with_cell, *without_cell;
};

/// Nothing where one of the two was not measured.
[[nodiscard]] std::optional<MeasuredContrast> measured(const Contrast& contrast, const std::vector<ResultsRow>& rows);

/// The first line of a table of contrasts: what two traced maps of the views differ by, and cells that stay empty. No
/// line without such views.
[[nodiscard]] std::string truth_line(const ResultsPlan& plan, const std::vector<ResultsRow>& rows, ViewKind kind,
                                     const char* empty_cells);

}  // namespace sigmascape::cli
