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

/// Whether both are of the same views of the same scene, so that their errors can be weighed against other contrasts'
/// of that kind.
[[nodiscard]] bool are_of_the_same_views(const Contrast& contrast);

/// Causes of the error that are measured at views of one kind, each switched off alone.
[[nodiscard]] std::vector<Contrast> causes(const ResultsPlan& plan, ViewKind kind);
/// Changes that might pay, each made alone: `with` is after, `without` before the change.
[[nodiscard]] std::vector<Contrast> changes(const ResultsPlan& plan);

/// Markdown: each cause with the error when it is there and when it is not, at 8 m cells.
[[nodiscard]] std::string causes_table(const ResultsPlan& plan, const std::vector<ResultsRow>& rows, ViewKind kind);
/// Markdown: each change with error, bytes and frame time before and after.
[[nodiscard]] std::string changes_table(const ResultsPlan& plan, const std::vector<ResultsRow>& rows);
/// What the error falls by for a megabyte more of elevations, and of azimuths, in a sentence.
[[nodiscard]] std::string worth_of_looks(const ResultsPlan& plan, const std::vector<ResultsRow>& rows);
/// The causes without which the RMS of dB and the relative L1 fall most, among those that are measured at the same
/// views of one kind, in words.
[[nodiscard]] std::string largest_causes(const ResultsPlan& plan, const std::vector<ResultsRow>& rows, ViewKind kind);

}  // namespace sigmascape::cli
