#pragma once

#include <string>
#include <vector>

#include "results_plan.h"
#include "results_table.h"

namespace sigmascape::cli {

/// Two cases that differ in one thing alone.
struct Contrast {
  std::string name;
  std::string how;  ///< the case with it against the case without it, in words
  ResultsCase with, without;
};

/// Causes of the error, each switched off alone.
[[nodiscard]] std::vector<Contrast> causes(const ResultsPlan& plan);
/// Changes that might pay, each made alone: `with` is after, `without` before the change.
[[nodiscard]] std::vector<Contrast> changes(const ResultsPlan& plan);

/// Markdown: each cause with the error when it is there and when it is not, at 8 m cells.
[[nodiscard]] std::string causes_table(const ResultsPlan& plan, const std::vector<ResultsRow>& rows);
/// Markdown: each change with error, bytes and frame time before and after.
[[nodiscard]] std::string changes_table(const ResultsPlan& plan, const std::vector<ResultsRow>& rows);
/// What the error falls by for a megabyte more of elevations, and of azimuths, in a sentence.
[[nodiscard]] std::string worth_of_looks(const ResultsPlan& plan, const std::vector<ResultsRow>& rows);
/// The cause without which the RMS of dB falls most, in a sentence.
[[nodiscard]] std::string largest_cause(const ResultsPlan& plan, const std::vector<ResultsRow>& rows);

}  // namespace sigmascape::cli
