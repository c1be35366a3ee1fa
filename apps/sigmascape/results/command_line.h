#pragma once

#include <string>

#include "results/plan.h"

namespace sigmascape::cli {

/// The path from the current folder; empty where it leads out of it, and for none.
[[nodiscard]] std::string path_within(const std::string& path);

/// The line that makes the same page again: "sigmascape results --scale 0.2 --held-out 24 …", with all that decides its
/// numbers spelled out, whether it was given or followed from something else. Files within the current folder are named
/// from there. Of others, which tell of the machine alone, a scene is named by its last part and the rest not at all.
[[nodiscard]] std::string command_line(const ResultsOptions& options, const ResultsPlan& plan);

}  // namespace sigmascape::cli
