#pragma once

#include <string>
#include <vector>

#include "results/contrast.h"

namespace sigmascape::cli {

/// A change that might pay, made alone: `with` is after, `without` before it.
struct Change {
  Contrast contrast;
  std::string kept;  ///< what the program makes of it: "kept", "not kept", or under what terms
};

[[nodiscard]] std::vector<Change> changes(const ResultsPlan& plan);

/// Markdown: each change with error, bytes and frame time before and after, and whether it was kept.
[[nodiscard]] std::string changes_table(const ResultsPlan& plan, const std::vector<ResultsRow>& rows);
/// What the error falls by for a megabyte more of elevations, and of azimuths, what the next finer grid takes and
/// gives beside the one that is baked by default, and what is chosen, in sentences.
[[nodiscard]] std::string worth_of_looks(const ResultsPlan& plan, const std::vector<ResultsRow>& rows);
/// Markdown: the section.
[[nodiscard]] std::string changes_section(const ResultsPlan& plan, const std::vector<ResultsRow>& rows);

}  // namespace sigmascape::cli
